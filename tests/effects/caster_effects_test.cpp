// A swivelling caster against planar kinematics: its wheel does not slip sideways, so the swivel angle a obeys
//   turning in place:  da/dtheta = (x cos a - L) / L      rolling straight:  da/ds = -sin a / L
// with the swivel axis x ahead of the axle and the trail L. It shows by where it carries its load, and by the bearing's
// friction: the floor then pushes sideways with up to M / L, and creeping tyres let the robot yaw.
#include <gtest/gtest.h>

#include <iostream>
#include <string>

#include "effects/contact.h"
#include "tests/effects/trial_drive.h"

namespace umbsim {
namespace {

using testing::kCreep;
using testing::kG;
using testing::kWheelbase_m;
using testing::rig_with;
using testing::TrialDrive;

constexpr double kTrail_m = 0.03, kFriction_nm = 0.2, kSwivel_m = 0.25;
constexpr double kTurn_rad = M_PI / 2;

double turned(double a, double angle_rad) {
  constexpr int kSteps = 20000;
  for (int i = 0; i < kSteps; ++i) {
    const auto rate = [&](double at) { return (kSwivel_m * std::cos(at) - kTrail_m) / kTrail_m; };
    const double h = angle_rad / kSteps, middle = a + rate(a) * h / 2;
    a += rate(middle) * h;
  }
  return a;
}

double rolled(double a, double distance_m) { return 2 * std::atan(std::tan(a / 2) * std::exp(-distance_m / kTrail_m)); }

double caster_load(const RobotModel& robot, double a) {
  const double reach_m = kSwivel_m - kTrail_m * std::cos(a);
  const double fork_n = robot.casters[0].fork.mass_kg * kG, wheel_n = robot.casters[0].wheel_mass_kg * kG;
  return (40 * kG * 0.06 + fork_n * kSwivel_m) / reach_m + wheel_n;
}

TEST(CasterSwivel, FollowsItsTrail) {
  // Finite steps (20 ms) while the fork swings at several rad/s; the load follows the angle by 13 % per radian.
  constexpr double kStep = 2e-3;
  const Rig rig = rig_with(CasterSwivel{kTrail_m, 0, 0});
  for (const double turn_rad : {0.1, 0.3, 1.2}) {
    TrialDrive drive(rig);
    EXPECT_NEAR(drive.world.loads().caster_n[0], caster_load(rig.robot, 0), 1e-3);
    drive.leg(0, turn_rad / 2, 1);
    const double a = turned(0, turn_rad);
    for (const double distance_m : {0.0, 0.02, 0.05}) {
      TrialDrive on(rig);
      on.leg(0, turn_rad / 2, 1);
      if (distance_m > 0) on.leg(distance_m / 2, 0, 1);
      const double expected = caster_load(rig.robot, rolled(a, distance_m));
      const double measured = on.world.loads().caster_n[0];
      std::cout << "turned " << turn_rad << " rad, rolled " << distance_m << " m: caster load " << measured << " N ("
                << expected << ")\n";
      EXPECT_NEAR(measured, expected, kStep * expected);
    }
  }
}

// The planar law knows no inertia and no finite step: slowly, and in short steps.
constexpr double kSlow_mps = 0.02, kSwivelModel = 0.01;

PhysicsOptions short_steps() {
  PhysicsOptions options;
  options.step_s = 0.002;
  return options;
}

// Heading per metre at the swivel angle a, for each newton with which the floor pushes the caster across its fork: a
// moment of x cos a - L about the axle's middle, and a drag of sin a. Creeping wheels balance both; the caster's place,
// L sin a off the middle, makes their loads unequal.
double kick_rate_per_n(const RobotModel& robot, double a) {
  const double wheels_n = robot.total_mass_kg() * kG - caster_load(robot, a);
  const double on_frame_n = caster_load(robot, a) - robot.casters[0].wheel_mass_kg * kG;
  const double sideways_n = on_frame_n * kTrail_m * std::sin(a) / kWheelbase_m;
  const double left_n = wheels_n / 2 + sideways_n, right_n = wheels_n / 2 - sideways_n;
  const double half_drag = std::sin(a) / 2;
  const double couple = (kSwivel_m * std::cos(a) - kTrail_m) / kWheelbase_m;
  return kCreep / kWheelbase_m * ((half_drag + couple) / left_n - (half_drag - couple) / right_n);
}

// F = M / L, or less where the friction fades: in proportion to how fast the fork swings back, from which the kick
// itself takes.
double kick_rate(const RobotModel& robot, double a) {
  const Caster& c = robot.casters[0];
  const double full_n = kFriction_nm / kTrail_m, per_n = kick_rate_per_n(robot, a);
  const double swing_n = full_n * c.radius_m / (c.bearing_creep * kTrail_m * std::cos(a));
  const double faded_n = swing_n * std::abs(std::sin(a)) / (1 + swing_n * per_n * (kSwivel_m * std::cos(a) - kTrail_m));
  return per_n * std::copysign(std::min(full_n, faded_n), a);
}

// Heading error after `distance_m` of a leg that begins with the swivel angle a. The kick itself swings the caster,
// too.
double kick(const RobotModel& robot, double a, double distance_m) {
  constexpr int kSteps = 5000;
  const double h = distance_m / kSteps;
  const auto swing = [&](double at) {
    return (kick_rate(robot, at) * (kSwivel_m * std::cos(at) - kTrail_m) - std::sin(at)) / kTrail_m;
  };
  double heading = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double middle = a + swing(a) * h / 2;
    heading += h * kick_rate(robot, middle);
    a += h * swing(middle);
  }
  return heading;
}

struct Kick {
  double near = 0;  ///< three trail-lengths into the leg
  double far = 0;   ///< at its end
};

constexpr double kNear_m = 3 * kTrail_m, kFar_m = 0.6;

Kick model(const RobotModel& robot, double a) { return {kick(robot, a, kNear_m), kick(robot, a, kFar_m)}; }

Kick drive_leg(TrialDrive& drive) {
  const double before = drive.error().theta_rad, start_m = drive.rolled_m;
  Kick result;
  drive.ramp(kSlow_mps, 0, 0.4);
  const auto go_until = [&](double distance_m) {
    while (drive.rolled_m - start_m < distance_m) drive.go(kSlow_mps, 0, 0.02);
    return drive.error().theta_rad - before;
  };
  result.near = go_until(kNear_m);
  result.far = go_until(kFar_m);
  return result;
}

Kick kick_after_turn(const Rig& rig, int sense) {
  TrialDrive drive(rig, short_steps());
  drive.leg(0, sense * kTurn_rad / 2, 1);
  return drive_leg(drive);
}

Rig creeping_rig(double initial_angle_rad = 0) {
  return rig_with(TyreCreep{kCreep, 0}, CasterSwivel{kTrail_m, kFriction_nm, initial_angle_rad});
}

void expect_kick(const Kick& measured, const Kick& expected, const std::string& what) {
  std::cout << what << ": " << measured.near << " rad after three trails (" << expected.near << "), " << measured.far
            << " rad after " << kFar_m << " m (" << expected.far << ")\n";
  EXPECT_NEAR(measured.near, expected.near, kSwivelModel * std::abs(expected.near)) << what;
  EXPECT_NEAR(measured.far, expected.far, kSwivelModel * std::abs(expected.far)) << what;
}

TEST(CasterSwivel, KicksInTheFirstTrailLengthsWithTheSignOfTheLastTurn) {
  const Rig rig = creeping_rig();
  const double a = turned(0, kTurn_rad);
  const Kick left = kick_after_turn(rig, 1), right = kick_after_turn(rig, -1);
  expect_kick(left, model(rig.robot, a), "after a turn to the left");
  expect_kick(right, model(rig.robot, -a), "after a turn to the right");
  EXPECT_GT(left.far, 0);
  EXPECT_LT(right.far, 0);
}

// The fork swings back by exp(-1) in a trail-length, and a bearing that hardly creeps pushes until it has.
TEST(CasterSwivel, ADryBearingPushesFurtherIntoTheLeg) {
  const double a = turned(0, kTurn_rad);
  double before = 0;
  for (const double creep : {0.05, 0.01, 0.002}) {
    const Rig rig = rig_with(TyreCreep{kCreep, 0}, CasterSwivel{kTrail_m, kFriction_nm, 0, creep});
    const Kick kick = kick_after_turn(rig, 1);
    expect_kick(kick, model(rig.robot, a),
                "a bearing that creeps at " + std::to_string(creep) + " of the rolling rate");
    EXPECT_GT(kick.far, 1.2 * before);
    before = kick.far;
  }
}

TEST(CasterSwivel, DoesNotKickTheFirstLegWhereItStartsAligned) {
  constexpr double kNothing = 1e-6;  // of the kick after a turn
  const Rig rig = creeping_rig();
  TrialDrive drive(rig);
  const Kick first = drive_leg(drive);
  std::cout << "first leg, aligned: " << first.far << " rad\n";
  EXPECT_LT(std::abs(first.near) + std::abs(first.far), kNothing * std::abs(kick_after_turn(rig, 1).far));
}

TEST(CasterSwivel, KicksTheFirstLegWhereItStartsAskew) {
  for (const double a : {0.5, -1.4}) {
    const Rig rig = creeping_rig(a);
    TrialDrive drive(rig, short_steps());
    expect_kick(drive_leg(drive), model(rig.robot, a), "askew by " + std::to_string(a) + " rad");
  }
}

TEST(CasterSwivel, WithoutFrictionOrCreepThereIsNoKick) {
  const auto far = [](const Rig& rig) { return std::abs(kick_after_turn(rig, 1).far); };
  const double with = far(creeping_rig());
  // What is left: the fork's and wheel's inertia as they swing round.
  const double free = far(rig_with(TyreCreep{kCreep, kCreep}, CasterSwivel{kTrail_m, 0, 0}));
  const double rigid = far(rig_with(CasterSwivel{kTrail_m, kFriction_nm, 0}));
  std::cout << "kick " << with << " rad; free bearing " << free << "; rigid tyres " << rigid << "\n";
  EXPECT_LT(free, 2e-3 * with);
  EXPECT_LT(rigid, 1e-3 * with);
}

// A URDF's caster may name any point on its swivel axis: the wheel stays on the floor.
TEST(CasterSwivel, KeepsTheHeightOfACasterThatSwivelsAlready) {
  Rig rig = rig_with();
  Caster& c = rig.robot.casters[0];
  const double height_m = c.centre_m.z();
  c.swivels = true;
  c.swivel_point_m = {kSwivel_m, 0, 0};
  apply(CasterSwivel{kTrail_m, kFriction_nm, 0}, rig);
  EXPECT_EQ(c.centre_m.z(), height_m);
  EXPECT_EQ(c.centre_m.x(), kSwivel_m - kTrail_m);
}

// On motors that give way a robot whose caster drags stops and stands: dry friction holds it, and nothing trembles.
TEST(MotorResponse, DroopLetsADraggingRobotStand) {
  Rig rig = rig_with(CasterDrag{0.02, 0.05});
  for (Motor& m : rig.drivetrain.motor) m.droop_radps_per_nm = 0.2;
  TrialDrive drive(rig);
  drive.ramp(0.2, 0.3, 1);
  drive.go(0.2, 0.3, 1);
  drive.ramp(0, 0, 1);
  drive.go(0, 0, 2);
  const Pose2 before = drive.world.pose();
  const std::int64_t newton_steps = drive.world.cost().newton_steps;
  drive.go(0, 0, 10);
  const Pose2 after = drive.world.pose();
  std::cout << "moved by " << std::hypot(after.x_m - before.x_m, after.y_m - before.y_m) << " m and "
            << after.theta_rad - before.theta_rad << " rad while it stood\n";
  EXPECT_LT(std::hypot(after.x_m - before.x_m, after.y_m - before.y_m), 1e-6);
  EXPECT_LT(std::abs(after.theta_rad - before.theta_rad), 1e-6);
  EXPECT_EQ(drive.world.cost().newton_steps, newton_steps) << "nothing slides";
}

}  // namespace
}  // namespace umbsim
