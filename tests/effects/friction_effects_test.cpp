// Where friction ends: demanded traction against mu N, on slippery floors and patches, and on none at all.
#include <gtest/gtest.h>

#include <iostream>

#include "effects/drivetrain.h"
#include "effects/floor.h"
#include "experiment/drive/drive_run.h"
#include "tests/effects/trial_drive.h"
#include "tests/experiment/scenarios.h"

namespace umbsim {
namespace {

using testing::kG;
using testing::kRadius_m;
using testing::kWheelbase_m;
using testing::rig_with;
using testing::TrialDrive;

constexpr double kNoSlip_m = 1e-7;  // "rigid" contact, 1e-9 m/s per newton

/// The robot of round numbers, for moments about the line on which its wheels stand.
struct Tipping {
  double m = 42, base_kg = 40, x_b = 0.06, x_c = 0.25;
  double height_m = kRadius_m + 0.05;                             ///< of the base's centre of mass
  double spin_kgm2 = 2 * kRadius_m * kRadius_m / 2;               ///< both wheels
  double share() const { return 1 - base_kg * x_b / (m * x_c); }  ///< of the weight, on the wheels at rest

  /// Acceleration a with m a = mu N: braking and starting load caster and wheels differently. sense: +1 starting.
  double limit_mps2(double mu, int sense) const {
    const double lift = (base_kg * height_m + (m - base_kg) * kRadius_m + spin_kgm2 / kRadius_m) / x_c;
    return mu * m * kG * share() / (m - sense * mu * lift);
  }
  /// Turning rate at which the centre of mass pulls the wheels off: m_b x_b w^2 = mu N.
  double limit_radps(double mu) const {
    return std::sqrt(mu * m * kG * share() / (base_kg * x_b * (1 + mu * height_m / x_c)));
  }
};

// Truth minus odometry after a start (or stop) at constant acceleration, when wheels and robot go alike again and the
// robot, which tips under acceleration and takes its encoders along, is level again.
constexpr double kLevel_s = 1;
double slip_of_ramp(double a_mps2, double mu, int sense) {
  constexpr double kRamp_s = 0.4;
  TrialDrive drive(rig_with(SlipperyFloor{mu}));
  if (sense > 0) {
    drive.ramp(a_mps2 * kRamp_s, 0, kRamp_s);
    drive.go(a_mps2 * kRamp_s, 0, kLevel_s);
    return drive.error().x_m;
  }
  drive.ramp(a_mps2 * kRamp_s, 0, 20 * kRamp_s);
  drive.go(a_mps2 * kRamp_s, 0, 1);
  const double before_m = drive.error().x_m;
  drive.ramp(0, 0, kRamp_s);
  drive.go(0, 0, kLevel_s);
  return drive.error().x_m - before_m;
}

TEST(SlipperyFloor, SlipBeginsWhereDemandedTractionExceedsMuN) {
  // Of the slip; and of the limit, by which springs that tip first and 20 ms steps move it.
  constexpr double kModel = 0.03, kLimit = 0.002;
  for (const double mu : {0.05, 0.2, 0.4}) {
    for (const int sense : {1, -1}) {
      const double limit = Tipping{}.limit_mps2(mu, sense);
      // Until it has tipped, a starting robot has only its wheels' load at rest.
      const double at_rest = std::min(limit, mu * kG * Tipping{}.share());
      for (const double part : {0.5, 0.98}) EXPECT_NEAR(slip_of_ramp(part * at_rest, mu, sense), 0, kNoSlip_m);
      for (const double part : {1.02, 1.2}) {
        // Behind (part - 1) a t^2 / 2 at the ramp's end, and (dv)^2 / 2a more until it has caught up.
        const double expected_m = -sense * part * (part - 1) * limit * 0.4 * 0.4 / 2;
        const double slip_m = slip_of_ramp(part * limit, mu, sense);
        std::cout << "mu " << mu << (sense > 0 ? ", start at " : ", stop at ") << part << " of the limit " << limit
                  << " m/s2: slip " << slip_m << " m (" << expected_m << ")\n";
        EXPECT_NEAR(slip_m, expected_m, kModel * std::abs(expected_m) + kLimit * limit * 0.4 * 0.4 / 2);
      }
    }
  }
}

// One square by the driver; the turns far below the limit.
DrivenRun driven(const std::string& name, const std::vector<std::string>& settings, Direction direction) {
  const Scenario scenario = testing::shipped(name, settings);
  const RobotModel robot = load_scenario_robot(scenario);
  return drive_run(scenario, robot, initial_odometry(scenario, robot), {"run", direction, false, 0});
}

Pose2 last_pose(const DrivenRun& d) { return d.run.truth.back().X_WB; }

TEST(OverAcceleration, StopsSlipFirst) {
  const double stop = Tipping{}.limit_mps2(0.4, -1);  // a start still holds there, and the caster stays down
  EXPECT_LT(1.1 * stop, 0.4 * kG * Tipping{}.share());
  const auto slipping = [](double a_mps2) {
    return driven(
        "effects/over_acceleration",
        {"course.side_m=2", "course.linear_speed_mps=1", "course.angular_acceleration_radps2=0.1",
         "physics.step_s=0.02",  // long enough that the robot's nod as it sets off is over within a step
         "effects.slippery_floor.friction=0.4", "effects.over_acceleration.factor=" + std::to_string(a_mps2 / 0.25)},
        Direction::ccw);
  };
  const DrivenRun below = slipping(0.95 * stop), above = slipping(1.1 * stop);
  std::cout << "limit of stopping " << stop << " m/s2: slipping steps below " << below.cost.newton_steps << ", above "
            << above.cost.newton_steps << "\n";
  EXPECT_EQ(below.cost.newton_steps, 0);
  EXPECT_LT(std::hypot(last_pose(below).x_m, last_pose(below).y_m), 1e-4);
  EXPECT_GT(above.cost.newton_steps, 4) << "at every stop";
}

TEST(FastTurning, SkidsWhereTheCentreOfMassPullsTheWheelsOff) {
  for (const double mu : {0.05, 0.1, 0.3}) {
    const double limit = Tipping{}.limit_radps(mu);
    for (const int sense : {1, -1}) {
      const auto moved_m = [&](double part) {
        TrialDrive drive(rig_with(SlipperyFloor{mu}));
        drive.ramp(0, sense * 0.9 * limit, 20);  // slowly: angular acceleration asks for traction of its own
        drive.ramp(0, sense * part * limit, 10);
        drive.go(0, sense * part * limit, 2);
        return std::hypot(drive.error().x_m, drive.error().y_m);
      };
      std::cout << "mu " << mu << ", limit " << sense * limit << " rad/s: moved " << moved_m(0.98) << " m below, "
                << moved_m(1.03) << " m above\n";
      EXPECT_LT(moved_m(0.98), 10 * kNoSlip_m);
      EXPECT_GT(moved_m(1.03), 1e-3);
    }
  }
}

TEST(FastTurning, IsTheDemandOfTurnsOnly) {
  Rig rig;
  apply(FastTurning{8}, rig);
  EXPECT_EQ(rig.commanded_motion.turn_speed_factor, 8);
  EXPECT_EQ(rig.commanded_motion.acceleration_factor, 1);
  const std::string slow = "effects.fast_turning.factor=1";
  for (const Direction direction : {Direction::cw, Direction::ccw}) {
    const DrivenRun calm = driven("effects/fast_turning", {"course.side_m=1", slow}, direction);
    const DrivenRun fast = driven("effects/fast_turning", {"course.side_m=1"}, direction);
    EXPECT_EQ(calm.cost.newton_steps, 0);
    EXPECT_LT(std::hypot(last_pose(calm).x_m, last_pose(calm).y_m), 1e-4);
    EXPECT_GT(std::hypot(last_pose(fast).x_m, last_pose(fast).y_m), 1e-3);
  }
}

// Starting inside, cruising through, passing beside.
Pose2 patch_error(double x_m, double y_m, double friction = 0.02) {
  TrialDrive drive(rig_with(SlipperyPatch{x_m, y_m, 0.1, friction}));
  drive.ramp(0.4, 0, 0.4);
  drive.go(0.4, 0, 4);
  return drive.error();
}

TEST(SlipperyPatch, ActsOnlyInsideTheDiscAndUnderDemand) {
  const double y = kWheelbase_m / 2;
  const Pose2 right = patch_error(0, -y), left = patch_error(0, y);
  std::cout << "patch under the right wheel at the start: heading " << right.theta_rad << " rad\n";
  EXPECT_LT(right.theta_rad, -1e-3) << "the right wheel does not push";
  EXPECT_NEAR(left.theta_rad, -right.theta_rad, 1e-9);
  EXPECT_NEAR(left.y_m, -right.y_m, 1e-9);
  const Pose2 cruise = patch_error(1, -y), beside = patch_error(0, 0), ample = patch_error(0, -y, 0.9);
  for (const Pose2& none : {cruise, beside, ample}) {
    EXPECT_NEAR(std::hypot(none.x_m, none.y_m), 0, kNoSlip_m);
    EXPECT_NEAR(none.theta_rad, 0, kNoSlip_m);
  }
}

// The right wheel lifted, the left one starts with speed u(t) and holds the axle sideways; the rest of the robot is
// free to yaw about it. Virtual power of a yaw rate w at given u, with v = u + w b/2 at the axle's middle:
//   m_b [b/2 (v' - x w^2) + x (v w + x w')] + m_r b (v' + w' b/2) + I w' = 0        (m_r: the right wheel, b away)
// and the left wheel's mass moves with u along, with nothing across.
double yaw_of_lifted_start(double a_mps2, double duration_s, double x_b) {
  constexpr int kSteps = 4000;
  const double b = kWheelbase_m, m = 40, wheel_kg = 1;
  const double inertia = 1.4 + 2 * (wheel_kg * kRadius_m * kRadius_m / 4);
  double w = 0, heading = 0;
  const double h = duration_s / kSteps;
  const auto rate = [&](double t, double at) {
    const double v = a_mps2 * t + at * b / 2;
    const double drive = m * b / 2 * (a_mps2 - x_b * at * at) + m * x_b * v * at + wheel_kg * b * a_mps2;
    return -drive / (m * b * b / 4 + m * x_b * x_b + wheel_kg * b * b + inertia);
  };
  for (int i = 0; i < kSteps; ++i) {
    const double middle = w + rate(i * h, w) * h / 2;
    heading += middle * h;
    w += rate((i + 0.5) * h, middle) * h;
  }
  return heading;
}

TEST(WheelLift, OneWheelTurnsForNothing) {
  constexpr double kModel = 0.01;  // 20 ms steps, first order
  for (const double a_mps2 : {0.05, 0.25, 0.5}) {
    for (const int side : {1, -1}) {
      TrialDrive drive(rig_with(WheelLift{0, -side * kWheelbase_m / 2, 0.2}));
      drive.ramp(a_mps2 * 0.4, 0, 0.4);
      // Steps move the robot at their last speed: it has gone a little further than a t^2 / 2, and turned as much more.
      const double further = drive.odometry.x_m / (a_mps2 * 0.4 * 0.4 / 2);
      const double expected = side * further * yaw_of_lifted_start(a_mps2, 0.4, 0.06);
      std::cout << "lifted at " << a_mps2 << " m/s2: yaw " << drive.error().theta_rad << " rad (" << expected << ", "
                << 100 * (drive.error().theta_rad / expected - 1) << " %)\n";
      EXPECT_NEAR(drive.error().theta_rad, expected, kModel * std::abs(expected));
      EXPECT_NEAR(drive.odometry.theta_rad, 0, 1e-9) << "the odometry sees a straight start";
    }
  }
}

TEST(WheelLift, NeedsADemandAndAPlace) {
  const auto error = [](double x_m, double length_m) {
    TrialDrive drive(rig_with(WheelLift{x_m, -kWheelbase_m / 2, length_m}));
    drive.ramp(0.2, 0, 1);
    drive.go(0.2, 0, 5);
    return std::abs(drive.error().theta_rad);
  };
  EXPECT_LT(error(0.6, 0.1), kNoSlip_m) << "at constant speed nothing is asked of the lifted wheel";
  EXPECT_LT(error(0, 0), kNoSlip_m);
  EXPECT_GT(error(0, 0.1), 1e-3);
}

}  // namespace
}  // namespace umbsim
