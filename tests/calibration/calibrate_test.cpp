// Calibration under exact kinematics: measure, correct, drive again.
#include "calibration/calibrate.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iostream>

#include "experiment/scenario/scenario.h"
#include "tests/umbmark/exact_kinematics.h"

namespace umbsim {
namespace {

using testing::nominal_odometry;
using testing::squares;
using testing::TrueRobot;

constexpr double kTicks_m = 2e-8;  // 1e9 ticks per revolution, over 16 m of path and its headings
constexpr double kRoundOff = 1e-12;

Umbmark measure(const TrueRobot& robot, const OdometryParameters& odometry) {
  return umbmark(squares(robot, odometry), odometry);
}

TEST(Calibrate, HeadingFormLeavesNoErrorAtAll) {
  for (const double e_d : {0.99, 1.00084, 1.01}) {
    for (const double e_b : {0.96, 336.17 / 340, 1.04}) {
      const TrueRobot robot = TrueRobot::with(e_d, e_b);
      const OdometryParameters odometry =
          corrected(nominal_odometry(), estimate(measure(robot, nominal_odometry()), CalibrationMethod::heading));
      EXPECT_NEAR(odometry.left_radius_m, robot.left_radius_m, kTicks_m);
      EXPECT_NEAR(odometry.right_radius_m, robot.right_radius_m, kTicks_m);
      EXPECT_NEAR(odometry.wheelbase_m, robot.wheelbase_m, kTicks_m);
      const Umbmark again = measure(robot, odometry);
      EXPECT_LT(again.e_max_syst_m, kTicks_m);
      EXPECT_NEAR(again.cw.heading_rad, 0, kTicks_m);
      EXPECT_NEAR(again.ccw.heading_rad, 0, kTicks_m);
    }
  }
}

// The end-point form is a small-angle approximation: it leaves an error of second order, which a second pass removes.
TEST(Calibrate, EndpointFormConvergesByIteration) {
  const TrueRobot robot = TrueRobot::with(1.005, 1.02);
  OdometryParameters odometry = nominal_odometry();
  double last_m = measure(robot, odometry).e_max_syst_m;
  for (int pass = 1; pass <= 3; ++pass) {
    odometry = corrected(odometry, estimate(measure(robot, odometry), CalibrationMethod::endpoint));
    const double e_max_m = measure(robot, odometry).e_max_syst_m;
    std::cout << "end-point form, pass " << pass << ": E_max " << 1000 * last_m << " -> " << 1000 * e_max_m << " mm\n";
    EXPECT_LT(e_max_m, last_m / 3);
    last_m = e_max_m;
  }
}

// UMBmark leaves the mean diameter alone.
TEST(Calibrate, KeepsTheMeanRadius) {
  const OdometryParameters before{0.0748, 0.0748, 0.34, 2000};
  for (const double beta : {-0.02, 0.0, 0.01}) {
    const OdometryParameters after = corrected(before, heading_estimate(0.03, beta, 4, 0.34));
    EXPECT_NEAR(after.left_radius_m + after.right_radius_m, 2 * 0.0748, kRoundOff);
    EXPECT_EQ(after.ticks_per_revolution, 2000);
  }
}

// No closed square can see a common scale of both wheels: calibration turns it into a wheelbase that closes the
// squares.
TEST(Calibrate, ScaleIsNotObservable) {
  TrueRobot robot = TrueRobot::with(1.003, 0.98);
  robot.left_radius_m *= 1.01;
  robot.right_radius_m *= 1.01;
  const OdometryParameters odometry =
      corrected(nominal_odometry(), estimate(measure(robot, nominal_odometry()), CalibrationMethod::heading));
  EXPECT_NEAR(odometry.left_radius_m + odometry.right_radius_m, 0.15, kRoundOff);
  EXPECT_NEAR(odometry.wheelbase_m, robot.wheelbase_m / 1.01, kTicks_m);
  EXPECT_LT(measure(robot, odometry).e_max_syst_m, kTicks_m);
}

TEST(Calibrate, NothingToCorrectChangesNothing) {
  const OdometryParameters o = corrected(nominal_odometry(), error_estimate(0, 0, 4, 0.34));
  EXPECT_EQ(o.left_radius_m, 0.075);
  EXPECT_EQ(o.right_radius_m, 0.075);
  EXPECT_EQ(o.wheelbase_m, 0.34);
}

TEST(Calibrate, YamlIsTheOdometryBlockOfAScenario) {
  const OdometryParameters odometry{0.0749685, 0.0750315, 0.33617, 2000};
  const auto file = std::filesystem::path(::testing::TempDir()) / ("calibrate_" + std::to_string(getpid()) + ".yaml");
  std::ofstream(file) << "format: umbsim-scenario/1\n" << calibration_yaml(odometry, "a comment");
  const Scenario scenario = read_scenario(file.string());
  constexpr double kWritten_m = 0.6e-9;  // nine decimals
  EXPECT_NEAR(scenario.odometry.left_radius_m.value(), odometry.left_radius_m, kWritten_m);
  EXPECT_NEAR(scenario.odometry.right_radius_m.value(), odometry.right_radius_m, kWritten_m);
  EXPECT_NEAR(scenario.odometry.wheelbase_m.value(), odometry.wheelbase_m, kWritten_m);
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace umbsim
