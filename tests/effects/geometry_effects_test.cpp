// Radii, wheelbase, load and wear against exact kinematics and statics. The oracles are the test's own.
#include <iostream>

#include "tests/effects/drives.h"
#include "tests/umbmark/exact_kinematics.h"

namespace umbsim {
namespace {

using testing::drive;
using testing::expect_near;
using testing::kRadius_m;
using testing::kWheelbase_m;
using testing::nominal_odometry;
using testing::square_run;
using testing::text;
using testing::TrueRobot;

constexpr double kPath_m = 16;
// The driver's pose correction takes the return path a little differently than the ideal square: 1e-4 of the error.
constexpr double kKinematic_m = 0.1e-3, kKinematic_rad = 2e-5;
// Effects of first order whose second order is not in the formula: relative to the figure.
constexpr double kSecondOrder = 0.005;
// Of loads by statics with the robot's lean: the supports' sinking, relative to the heading error; and the driver's
// way.
constexpr double kStatics = 0.0005;
// While it turns, the centre of mass ahead of the axle pulls outwards and unloads the wheels by a few parts in a
// thousand.
constexpr double kTurning = 0.003;

ReturnError exact(const TrueRobot& robot, bool cw) {
  return return_error(square_run(robot, nominal_odometry(), cw), nominal_odometry());
}

void expect_exact(const std::string& effects, const TrueRobot& robot) {
  const ExperimentResult r = drive(effects);
  for (const bool cw : {true, false}) {
    const ReturnError oracle = exact(robot, cw);
    const ReturnError& driven = (cw ? r.cw : r.ccw).errors.at(0);
    std::cout << effects << (cw ? " cw  " : " ccw ") << text(driven) << "; exact " << text(oracle) << "\n";
    expect_near(driven, oracle, kKinematic_m, kKinematic_rad, effects);
  }
}

TEST(WheelRadiusScale, IsExactKinematics) {
  for (const double e : {-0.01, 0.001, 0.01}) {
    expect_exact(fmt::format("wheel_radius_scale: {{relative: {}}}", e),
                 {kRadius_m * (1 + e), kRadius_m * (1 + e), kWheelbase_m});
  }
}

TEST(WheelRadiusDifference, IsExactKinematics) {
  for (const double e : {-0.002, 0.0005, 0.002}) {
    expect_exact(fmt::format("wheel_radius_difference: {{relative: {}}}", e), TrueRobot::with(1 + e, 1));
  }
}

TEST(Wheelbase, IsExactKinematics) {
  for (const double e : {-0.01, 0.002, 0.01}) {
    expect_exact(fmt::format("wheelbase: {{relative: {}}}", e), TrueRobot::with(1, 1 + e));
  }
}

// Loads of the LabMate at rest with a payload: base 40 kg at 60 mm ahead and 125 mm above the floor, wheels 1 kg,
// caster 250 mm ahead. The softer the tyres the more the robot leans to the loaded side, by c (N_L - N_R) / b, and all
// that is high loads that side further.
struct Loads {
  double left_n = 0;
  double right_n = 0;
};

Loads loads(double payload_kg, double ahead_m, double left_m, double compliance) {
  constexpr double g = 9.81, kCasterAhead_m = 0.250, kHeight_m = 0.1;
  const double caster_n = g * (40 * 0.060 + payload_kg * ahead_m) / kCasterAhead_m;
  const double both_n = g * (42 + payload_kg) - caster_n;
  const double high_kgm = 40 * 0.125 + 2 * kRadius_m + payload_kg * (kRadius_m + kHeight_m);
  const double lean = 2 * g * compliance * high_kgm / (kWheelbase_m * kWheelbase_m);
  const double difference_n = 2 * g * payload_kg * left_m / kWheelbase_m / (1 - lean);
  return {(both_n + difference_n) / 2, (both_n - difference_n) / 2};
}

TEST(LoadShift, TurnsTheLegsThroughTheTyres) {
  constexpr double kCompliance = 1.5e-6;
  struct Case {
    double payload_kg, ahead_m, left_m;
  };
  for (const Case& c : {Case{15, 0, 0.1}, {15, 0, -0.1}, {10, 0.1, 0.05}, {15, 0.05, 0}}) {
    const Loads n = loads(c.payload_kg, c.ahead_m, c.left_m, kCompliance);
    const ExperimentResult r =
        drive(fmt::format("load_shift: {{payload_kg: {}, ahead_m: {}, left_m: {}, height_m: 0.1}}, "
                          "tyre_compliance: {{metres_per_newton: {}}}",
                          c.payload_kg, c.ahead_m, c.left_m, kCompliance));
    const double per_metre = (r.cw.heading_rad + r.ccw.heading_rad) / 2 / kPath_m;
    const double expected = kCompliance * (n.left_n - n.right_n) / (kWheelbase_m * kRadius_m);
    std::cout << fmt::format("payload {} kg at ({}, {}) m: heading {:.4f} mrad/m; c (N_L - N_R) / (b R) {:.4f}\n",
                             c.payload_kg, c.ahead_m, c.left_m, 1e3 * per_metre, 1e3 * expected);
    EXPECT_NEAR(per_metre, expected, kStatics * std::abs(expected) + 1e-8);
    // The whole return error: exact kinematics of the radii that statics gives.
    const TrueRobot robot{kRadius_m - kCompliance * n.left_n, kRadius_m - kCompliance * n.right_n, kWheelbase_m};
    for (const bool cw : {true, false}) {
      const ReturnError oracle = exact(robot, cw);
      const ReturnError& driven = (cw ? r.cw : r.ccw).errors[0];
      std::cout << (cw ? "  cw  " : "  ccw ") << text(driven) << "; exact kinematics " << text(oracle) << "\n";
      const double turns_rad = M_PI * kCompliance * (n.left_n + n.right_n) / kRadius_m;
      const double off_rad = kStatics * std::abs(expected) * kPath_m + kTurning * turns_rad;
      expect_near(driven, oracle, 4 * off_rad + 1e-5, off_rad, "load shift");
    }
  }
}

TEST(LoadShift, DoesNothingToHardTyres) {
  const ExperimentResult r = drive("load_shift: {payload_kg: 15, left_m: 0.1}");
  std::cout << "payload on hard tyres: " << text(r.cw.errors[0]) << "\n";
  EXPECT_LT(r.cw.r_cg_m, kKinematic_m / 10);
  EXPECT_LT(std::abs(r.cw.heading_rad), kKinematic_rad / 10);
}

// Run n (all runs counted, from 0) has radii (1 + n rate): its error is that of a robot with these radii.
TEST(Wear, GrowsWithTheRunNumber) {
  constexpr double kRate = -0.0005;
  const ExperimentResult r =
      drive(fmt::format("wear: {{right_relative_per_run: {}}}", kRate), {"runs.per_direction=4"});
  const double unit_rad = kPath_m * kRate / kWheelbase_m;
  for (int i = 0; i < 4; ++i) {
    for (const bool cw : {true, false}) {
      const int number = 2 * i + (cw ? 0 : 1);
      const ReturnError& e = (cw ? r.cw : r.ccw).errors.at(i);
      const ReturnError oracle = exact({kRadius_m, kRadius_m * (1 + number * kRate), kWheelbase_m}, cw);
      std::cout << fmt::format("{} (run {}): {}; exact {}\n", e.run, number, text(e), text(oracle));
      expect_near(e, oracle, kKinematic_m * (1 + number), kKinematic_rad * (1 + number), e.run);
      // Linear: legs turn by the radius difference, turns by its half (the mean radius): 16 m / b and 2 pi / 2.
      const double turns_rad = (cw ? -1 : 1) * M_PI * kRate;
      EXPECT_NEAR(e.theta_rad, number * (unit_rad + turns_rad), kSecondOrder * std::abs(number * unit_rad) + 1e-6);
    }
  }
}

}  // namespace
}  // namespace umbsim
