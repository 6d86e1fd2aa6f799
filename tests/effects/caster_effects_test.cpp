// A swivelling caster against planar kinematics: its wheel does not slip sideways, so the swivel angle a obeys
//   turning in place:  da/dtheta = (x cos a - L) / L      rolling straight:  da/ds = -sin a / L
// with the swivel axis x ahead of the axle and the trail L. It shows by where it carries its load, and by the bearing's
// friction: the floor then pushes sideways with up to M / L, and creeping tyres let the robot yaw.
#include <gtest/gtest.h>

#include <iostream>

#include "effects/contact.h"
#include "tests/effects/trial_drive.h"

namespace umbsim {
namespace {

using testing::kG;
using testing::kWheelbase_m;
using testing::rig_with;
using testing::TrialDrive;

constexpr double kCreep = 0.02, kTrail_m = 0.03, kFriction_nm = 0.2, kSwivel_m = 0.25;
// The bearing's friction fades where a swivels slower than this share of the rolling rate (sim/step.cpp).
constexpr double kFade = 0.05;
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

// The planar law knows no inertia and no finite step: slowly.
constexpr double kSlow_mps = 0.02, kModel = 0.015;

// Heading error against distance on a leg that begins with the swivel angle a. Side force F = M / L (less where the
// friction fades) at the caster, moment (x cos a - L) F about the axle's middle, balanced by creeping tyres.
double kick(const RobotModel& robot, double a, double distance_m) {
  constexpr int kSteps = 5000;
  double heading = 0;
  const double h = distance_m / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    const double at = rolled(a, h / 2);
    a = rolled(a, h);
    const double swivel_per_roll = robot.casters[0].radius_m / kTrail_m * std::abs(std::tan(at));
    const double force_n = std::copysign(std::min(1.0, swivel_per_roll / kFade), at) * kFriction_nm / kTrail_m;
    const double wheels_n = robot.total_mass_kg() * kG - caster_load(robot, at);
    heading += h * 4 * kCreep * force_n * (kSwivel_m * std::cos(at) - kTrail_m) /
               (wheels_n * kWheelbase_m * kWheelbase_m);
  }
  return heading;
}

struct Kick {
  double first_leg = 0;
  double near = 0;  ///< three trail-lengths into the second leg
  double far = 0;   ///< at its end
};

Kick drive_corner(const Rig& rig, int sense) {
  TrialDrive drive(rig);
  drive.leg(0.2, 0, 3);
  Kick result;
  result.first_leg = drive.error().theta_rad;
  drive.leg(0, sense * kTurn_rad / 2, 1);
  const double before = drive.error().theta_rad, start_m = drive.rolled_m;
  drive.ramp(kSlow_mps, 0, 0.4);
  while (drive.rolled_m - start_m < 3 * kTrail_m) drive.go(kSlow_mps, 0, 0.02);
  result.near = drive.error().theta_rad - before;
  drive.go(kSlow_mps, 0, 30);
  result.far = drive.error().theta_rad - before;
  return result;
}

TEST(CasterSwivel, WithoutFrictionOrCreepThereIsNoKick) {
  const auto far = [](const Rig& rig) { return std::abs(drive_corner(rig, 1).far); };
  const double with = far(rig_with(TyreCreep{kCreep, kCreep}, CasterSwivel{kTrail_m, kFriction_nm, 0}));
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

}  // namespace
}  // namespace umbsim
