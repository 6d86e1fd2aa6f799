// The floor against closed forms and relations: slope, carpet, bumps, ripples, pushes.
#include <gtest/gtest.h>

#include <iostream>

#include "effects/contact.h"
#include "effects/floor.h"
#include "experiment/drive/drive_run.h"
#include "tests/effects/trial_drive.h"
#include "tests/experiment/scenarios.h"

namespace umbsim {
namespace {

using testing::kCreep;
using testing::kG;
using testing::kRadius_m;
using testing::kWheelbase_m;
using testing::rig_with;
using testing::Statics;
using testing::TrialDrive;

constexpr double kSlope_rad = 0.02;
// What "rigid" contact gives way to the weight's 8 N, at 1e-9 m/s per newton, in ten seconds; the same as an angle.
constexpr double kHeldDownhill_m = 4e-7, kHeldDownhill_rad = 4e-7;

// Creeping downhill on a leg of odometry `distance_m` along x: wheels push against the weight's slope component, each
// creeps by C F_i / N_i. The weight acts ahead of the axle, so the wheels must hold its yaw as well.
Pose2 creep_downhill(const RobotModel& robot, double downhill_rad, double distance_m, double start_rad) {
  constexpr int kSteps = 4000;
  const double base_kg = robot.base.mass_kg, m = robot.total_mass_kg(), x_c = robot.casters[0].centre_m.x();
  const double x_b = robot.base.com_m.x(), b = kWheelbase_m;
  const double tip_kgm = base_kg * (kRadius_m + robot.base.com_m.z()) + (m - base_kg) * kRadius_m;
  const double ds = distance_m / kSteps, down = kG * std::cos(kSlope_rad), slide = kG * std::sin(kSlope_rad);
  Pose2 X{0, 0, start_rad};
  for (int i = 0; i < kSteps; ++i) {
    const double gx = slide * std::cos(downhill_rad - X.theta_rad), gy = slide * std::sin(downhill_rad - X.theta_rad);
    const double wheels_n = m * down - (base_kg * down * x_b + tip_kgm * gx) / x_c;
    const double left_n = wheels_n / 2 + tip_kgm * gy / b, right_n = wheels_n / 2 - tip_kgm * gy / b;
    const double left_f = -m * gx / 2 + base_kg * x_b * gy / b, right_f = -m * gx / 2 - base_kg * x_b * gy / b;
    const double left = 1 - kCreep * left_f / left_n, right = 1 - kCreep * right_f / right_n;
    const double across = kCreep * m * gy / wheels_n;
    const double forward = (left + right) / 2, turn = (right - left) / b * ds, middle = X.theta_rad + turn / 2;
    X.x_m += (forward * std::cos(middle) - across * std::sin(middle)) * ds;
    X.y_m += (forward * std::sin(middle) + across * std::cos(middle)) * ds;
    X.theta_rad += turn;
  }
  return {X.x_m - distance_m, X.y_m, X.theta_rad - start_rad};
}

// What 2 m at cruise add to the error (wheels that are unevenly loaded also creep unevenly at the start and stop).
struct SlopeError {
  Pose2 added;
  double before_rad = 0;  ///< heading error where they begin
};

SlopeError slope_error(double creep, double downhill_rad, double start_rad = 0) {
  TrialDrive drive(rig_with(TyreCreep{creep, creep}, FloorSlope{kSlope_rad, downhill_rad}), {}, {0, 0, start_rad});
  drive.ramp(0.2, 0, 1);
  drive.go(0.2, 0, 0.4);
  const Pose2 before = drive.error();
  drive.go(0.2, 0, 10);
  const Pose2 after = drive.error();
  return {{after.x_m - before.x_m, after.y_m - before.y_m, after.theta_rad - before.theta_rad}, before.theta_rad};
}

TEST(FloorSlope, DoesNothingToARollingRobotWithoutCreep) {
  for (const double downhill_rad : {0.0, 1.0, -2.0}) {
    const Pose2 error = slope_error(0, downhill_rad).added;
    EXPECT_NEAR(std::hypot(error.x_m, error.y_m), 0, kHeldDownhill_m);
    EXPECT_NEAR(error.theta_rad, 0, kHeldDownhill_rad);
  }
}

TEST(FloorSlope, CreepsDownhill) {
  constexpr double kShare = 0.002;  // 20 ms steps; loads by first-order statics
  for (const double downhill_rad : {0.0, 1.0, M_PI / 2, 3.0, -1.0}) {
    const auto [e, before_rad] = slope_error(kCreep, downhill_rad);
    const Pose2 expected = creep_downhill(rig_with().robot, downhill_rad, 2, before_rad);
    std::cout << "downhill " << downhill_rad << ": " << e.x_m << ", " << e.y_m << " m, " << e.theta_rad << " rad ("
              << expected.x_m << ", " << expected.y_m << ", " << expected.theta_rad << ")\n";
    const double size_m = std::hypot(expected.x_m, expected.y_m);
    EXPECT_NEAR(e.x_m, expected.x_m, kShare * size_m);
    EXPECT_NEAR(e.y_m, expected.y_m, kShare * size_m);
    EXPECT_NEAR(e.theta_rad, expected.theta_rad, kShare * std::abs(expected.theta_rad) + kHeldDownhill_rad);
  }
}

TEST(FloorSlope, BelongsToTheFloor) {
  const Pose2 a = slope_error(kCreep, 1).added, turned = slope_error(kCreep, 1.7, 0.7).added;
  const Pose2 mirrored = slope_error(kCreep, -1).added;
  const Pose2 expected = Pose2{0, 0, 0.7} * Pose2{a.x_m, a.y_m, 0};
  EXPECT_NEAR(turned.x_m, expected.x_m, 1e-9);
  EXPECT_NEAR(turned.y_m, expected.y_m, 1e-9);
  EXPECT_NEAR(turned.theta_rad, a.theta_rad, 1e-9);
  EXPECT_NEAR(mirrored.y_m, -a.y_m, 1e-9);
  EXPECT_NEAR(mirrored.theta_rad, -a.theta_rad, 1e-9);
}

// Contacts whose friction is a damper let a robot down at a speed, whether it rolls or stands: each wheel by its own
// force along, both alike by half of what pulls across.
Pose2 slip_downhill(const RobotModel& robot, const TyreCreep& tyre, double downhill_rad, double speed_mps,
                    double seconds, double start_rad) {
  constexpr int kSteps = 4000;
  const double base_kg = robot.base.mass_kg, m = robot.total_mass_kg(), b = kWheelbase_m, dt = seconds / kSteps;
  Pose2 X{0, 0, start_rad};
  for (int i = 0; i < kSteps; ++i) {
    const double pull = kG * std::sin(kSlope_rad), to_it_rad = downhill_rad - X.theta_rad;
    const double gx = pull * std::cos(to_it_rad), gy = pull * std::sin(to_it_rad);
    const double yaw_n = base_kg * robot.base.com_m.x() * gy / b;  // ahead of the axle the weight turns it downhill
    const double left_mps = speed_mps + tyre.slip_along_mps_per_n * (m * gx / 2 - yaw_n);
    const double right_mps = speed_mps + tyre.slip_along_mps_per_n * (m * gx / 2 + yaw_n);
    const double along = (left_mps + right_mps) / 2 * dt, across = tyre.slip_across_mps_per_n * m * gy / 2 * dt;
    const double turn = (right_mps - left_mps) / b * dt, middle = X.theta_rad + turn / 2;
    X.x_m += along * std::cos(middle) - across * std::sin(middle);
    X.y_m += along * std::sin(middle) + across * std::cos(middle);
    X.theta_rad += turn;
  }
  return {X.x_m - speed_mps * seconds, X.y_m, X.theta_rad - start_rad};
}

TEST(TyreCreep, SlipAtAnySpeedLetsARobotDownASlope) {
  constexpr double kSeconds = 10, kShare = 1e-3;
  const TyreCreep tyre{0, 0, 2e-5, 1e-5};
  for (const double speed_mps : {0.0, 0.2}) {
    for (const double downhill_rad : {0.0, 1.0, M_PI / 2, -2.0}) {
      TrialDrive drive(rig_with(tyre, FloorSlope{kSlope_rad, downhill_rad}));
      drive.ramp(speed_mps, 0, 1);
      drive.go(speed_mps, 0, 0.4);
      const Pose2 before = drive.error();
      drive.go(speed_mps, 0, kSeconds);
      const Pose2 after = drive.error();
      const Pose2 e{after.x_m - before.x_m, after.y_m - before.y_m, after.theta_rad - before.theta_rad};
      const Pose2 expected = slip_downhill(rig_with().robot, tyre, downhill_rad, speed_mps, kSeconds, before.theta_rad);
      std::cout << "at " << speed_mps << " m/s, downhill " << downhill_rad << ": " << e.x_m << ", " << e.y_m << " m, "
                << e.theta_rad << " rad (" << expected.x_m << ", " << expected.y_m << ", " << expected.theta_rad
                << ")\n";
      const double size_m = std::hypot(expected.x_m, expected.y_m);
      EXPECT_NEAR(e.x_m, expected.x_m, kShare * size_m);
      EXPECT_NEAR(e.y_m, expected.y_m, kShare * size_m);
      EXPECT_NEAR(e.theta_rad, expected.theta_rad, kShare * std::abs(expected.theta_rad) + kHeldDownhill_rad);
    }
  }
}

// Four legs and four turns in place; the heading of the drift turns with the robot in a step, so a turn's share is off
// by up to half a step's angle.
TEST(CarpetDrift, IsTheSameVectorBothWaysRound) {
  constexpr double kDrift = 0.004, kDirection = 0.8, kRate = M_PI / 8, kStraight_m = 1e-9;
  for (const int sense : {1, -1, 0}) {
    TrialDrive drive(rig_with(CarpetDrift{kDrift, kDirection}));
    double legs_m = 0;
    for (int i = 0; i < (sense ? 4 : 1); ++i) {
      const double before_m = drive.rolled_m;
      drive.leg(0.2, 0, 4);
      legs_m += drive.rolled_m - before_m;
      if (sense) drive.leg(0, sense * kRate, 3);
    }
    const Pose2 e = drive.error();
    const double shift_m = kDrift * drive.rolled_m;
    const double x = shift_m * std::cos(kDirection), y = shift_m * std::sin(kDirection);
    std::cout << "carpet, sense " << sense << ": " << e.x_m << ", " << e.y_m << " m (" << x << ", " << y << ")\n";
    const double tolerance_m = kStraight_m + kDrift * (drive.rolled_m - legs_m) * kRate * 0.02 / 2;
    EXPECT_NEAR(e.x_m, x, tolerance_m);
    EXPECT_NEAR(e.y_m, y, tolerance_m);
    EXPECT_NEAR(e.theta_rad, 0, 1e-9);
  }
}

// The closed form of a round cable, with the wheel's sink under its load taken off the height.
// On an arc the wheels roll at different speeds. The carpet carries the robot by the mean of both, and does not turn
// it.
TEST(CarpetDrift, CarriesTheRobotOnAnArcToo) {
  constexpr double kDrift = 0.004, kDirection = 0.8, kMobility = 1e-7;
  for (const double turn_radps : {0.3, -0.5}) {
    TrialDrive drive(rig_with(CarpetDrift{kDrift, kDirection}));
    drive.leg(0.2, turn_radps, 6);
    const Pose2 e = drive.error();
    const double shift_m = kDrift * drive.rolled_m;
    const double tolerance_m = shift_m * std::abs(turn_radps) * 0.02 / 2;  // half a step of turning
    std::cout << "carpet, arc: " << e.x_m << ", " << e.y_m << " m, rolled " << drive.rolled_m << " m\n";
    EXPECT_NEAR(e.x_m, shift_m * std::cos(kDirection), tolerance_m);
    EXPECT_NEAR(e.y_m, shift_m * std::sin(kDirection), tolerance_m);
    EXPECT_NEAR(e.theta_rad, 0, kMobility) << "what contacts give under the curve's pull";
  }
}

TEST(Bump, TurnsTheRobotTowardsTheBumpedWheelAtItsPlace) {
  constexpr double kModel = 0.01;  // a wheel that climbs carries more than at rest; inertia
  const double sink_m = Softness{}.static_sink_m, R = kRadius_m;
  for (const double height_m : {0.003, 0.006, 0.010}) {
    const double r = (height_m - sink_m) / 2;
    const double gain_m = 2 * (R + r) * std::acos((R - r) / (R + r)) - 4 * std::sqrt(R * r);
    for (const int side : {1, -1}) {
      TrialDrive drive(rig_with(Bump{height_m, 0.6, side * kWheelbase_m / 2}));
      drive.ramp(0.1, 0, 1);
      drive.go(0.1, 0, 4);
      EXPECT_LT(std::abs(drive.error().theta_rad), 1e-6) << "not before the place";
      drive.go(0.1, 0, 4);
      const double step_rad = drive.error().theta_rad;
      drive.go(0.1, 0, 2);
      EXPECT_NEAR(drive.error().theta_rad, step_rad, 1e-6) << "nor after";
      std::cout << "bump " << height_m << ", side " << side << ": " << step_rad << " rad ("
                << side * gain_m / kWheelbase_m << ", " << 100 * (side * step_rad * kWheelbase_m / gain_m - 1)
                << " %)\n";
      EXPECT_NEAR(step_rad, side * gain_m / kWheelbase_m, kModel * gain_m / kWheelbase_m);
    }
  }
}

DrivenRun run(const std::string& name, const std::vector<std::string>& settings, const RunSpec& spec) {
  const Scenario scenario = testing::shipped(name, settings);
  const RobotModel robot = load_scenario_robot(scenario);
  return drive_run(scenario, robot, initial_odometry(scenario, robot), spec);
}

// Truth at the end of a square; the heading wrapped.
Pose2 end(const DrivenRun& driven) {
  Pose2 X_WB = driven.run.truth.back().X_WB;
  X_WB.theta_rad = wrap_angle(X_WB.theta_rad);
  return X_WB;
}

Pose2 uneven_end(double rms_m, int seed, int number = 0) {
  return end(run("effects/uneven_floor",
                 {"course.side_m=1", "effects.uneven_floor.rms_m=" + std::to_string(rms_m),
                  "effects.uneven_floor.seed=" + std::to_string(seed)},
                 {"ccw-1", Direction::ccw, false, number}));
}

TEST(UnevenFloor, IsTheSameInEveryRunAndAnotherForAnotherSeed) {
  const Pose2 a = uneven_end(0.001, 1, 0), b = uneven_end(0.001, 1, 3), c = uneven_end(0.001, 2, 0);
  EXPECT_EQ(a.x_m, b.x_m);
  EXPECT_EQ(a.theta_rad, b.theta_rad);
  EXPECT_GT(std::abs(a.theta_rad - c.theta_rad), 1e-6);
}

// A path over ripples is longer by half its mean squared slope: the wheels' difference grows with the square of height.
TEST(UnevenFloor, ErrorGrowsWithTheSquareOfItsHeight) {
  constexpr double kShare = 0.15;  // end points, where roll and pitch are of first order
  constexpr int kSeeds = 12;
  const auto rms_rad = [](double rms_m) {
    double sum = 0;
    for (int seed = 1; seed <= kSeeds; ++seed) sum += std::pow(uneven_end(rms_m, seed).theta_rad, 2);
    return std::sqrt(sum / kSeeds);
  };
  const double low = rms_rad(0.001), high = rms_rad(0.002);
  std::cout << "ripples: heading error " << low << " rad at 1 mm, " << high << " at 2 mm, ratio " << high / low << "\n";
  EXPECT_NEAR(high / low, 4, 4 * kShare);
}

Rig pushed(const PushEffect& push, double friction, const char* run = "") {
  Rig rig;
  rig.robot = testing::labmate();
  rig.run.id = run;
  apply(push, rig);
  apply(SlipperyFloor{friction}, rig);
  return rig;
}

TEST(Push, ChangesMomentumByItsImpulseWhereNothingHolds) {
  constexpr double kIce = 1e-4, kImpulse_ns = 10, kShare = 1e-3;
  const double held_mps = 1.5 * kIce * kG;  // what this ice takes away until the end of the measurement
  const RobotModel robot = testing::labmate();
  const double m = robot.total_mass_kg(), com_m = robot.base.mass_kg * robot.base.com_m.x() / m;
  const double inertia = 1.4 + 40 * std::pow(0.06 - com_m, 2) + 2 * (kRadius_m * kRadius_m / 4) +
                         2 * (kWheelbase_m * kWheelbase_m / 4 + com_m * com_m);
  for (const double ahead_m : {com_m, com_m + 0.02}) {
    TrialDrive drive(pushed({"", 1, 0.5, kImpulse_ns, M_PI / 2, ahead_m, 0.1}, kIce));
    drive.go(0, 0, 0.8);
    const Pose2 before = drive.world.pose();
    drive.go(0, 0, 0.2);
    const Pose2 after = drive.world.pose();
    const double turn_radps = (after.theta_rad - before.theta_rad) / 0.2;
    const double com_y_m = com_m * (std::sin(after.theta_rad) - std::sin(before.theta_rad));
    const double com_mps = (after.y_m - before.y_m + com_y_m) / 0.2;
    std::cout << "push " << ahead_m << " m ahead: " << com_mps << " m/s (" << kImpulse_ns / m << "), " << turn_radps
              << " rad/s (" << kImpulse_ns * (ahead_m - com_m) / inertia << ")\n";
    EXPECT_NEAR(com_mps, kImpulse_ns / m, kShare * kImpulse_ns / m + held_mps);
    EXPECT_NEAR(turn_radps, kImpulse_ns * (ahead_m - com_m) / inertia,
                kShare * kImpulse_ns * 0.02 / inertia + held_mps);
  }
}

TEST(Push, BelowTheFrictionLimitNothingMoves) {
  // 60 N against some 200 N that the wheels hold sideways and in yaw; beyond that it moves.
  const auto moved_m = [](double impulse_ns) {
    TrialDrive drive(pushed({"", 1, 0.5, impulse_ns, M_PI / 2, 0.1, 0.1}, 0.9));
    drive.go(0, 0, 2);
    return std::hypot(drive.error().x_m, drive.error().y_m) + std::abs(drive.error().theta_rad);
  };
  EXPECT_LT(moved_m(6), kHeldDownhill_m);
  EXPECT_GT(moved_m(60), 1e-3);
}

TEST(Push, IsGivenToTheNamedRunOnly) {
  PushEffect push{"ccw-1", 2, 6, 30};
  EXPECT_EQ(pushed(push, 0.9, "ccw-1").pushes.size(), 1u);
  EXPECT_EQ(pushed(push, 0.9, "cw-1").pushes.size(), 0u);
  push.run = "";
  EXPECT_EQ(pushed(push, 0.9, "cw-1").pushes.size(), 1u);
  const auto end_of = [](const RunSpec& spec) {
    return end(run("effects/push", {"course.side_m=2", "effects.push.impulse_newton_seconds=60"}, spec));
  };
  const Pose2 named = end_of({"ccw-1", Direction::ccw, false, 2}), other = end_of({"ccw-2", Direction::ccw, false, 3});
  EXPECT_GT(std::hypot(named.x_m, named.y_m), 1e-3);
  EXPECT_LT(std::hypot(other.x_m, other.y_m), 1e-4);
}

}  // namespace
}  // namespace umbsim
