// One cable under one wheel. A rigid wheel of radius R climbs a round cable of radius r on a path that is longer than
// the floor below it by Delta = 2 (R + r) psi - 4 sqrt(R r) with cos psi = (R - r) / (R + r): two arcs of radius R + r
// about the cable instead of the floor between the points where the wheel touches both. With equal wheel rotation the
// robot turns by Delta / b towards the bumped wheel.
#include <gtest/gtest.h>

#include <iostream>

#include "core/pose2.h"
#include "tests/sim/rolling_robot.h"

namespace umbsim {
namespace {

using testing::drive;
using testing::labmate;
using testing::placed;
using testing::small_robot;

// Soft contacts, the blow of the climb, a finite step: the bar of the project.
constexpr double kModelError = 0.04;
constexpr double kCableMirror = 1e-9;

double path_gain(double R, double r) { return 2 * (R + r) * std::acos((R - r) / (R + r)) - 4 * std::sqrt(R * r); }

struct Crossing {
  double heading_error_rad;
  PhysicsCost cost;
};

// Heading error of one crossing: true heading minus that of the wheel angles. `sense`: +1 forward, -1 backward.
Crossing cross(const RobotModel& robot, int wheel, int sense, double speed_mps, const PhysicsOptions& options = {},
               double height_m = 0.010, double friction = 0.9) {
  Floor floor;
  floor.friction = friction;
  World world = placed(robot, floor, options);
  Cable cable;
  cable.x_m = sense * 0.15;
  cable.y_m = robot.wheels[wheel].centre_m.y();
  cable.height_m = height_m;
  world.lay_cable(cable);
  const double R = robot.wheels[0].radius_m;
  const double command = sense * speed_mps / R;
  for (int i = 1; i <= 10; ++i) drive(world, command * i / 10, command * i / 10, 0.02);
  drive(world, command, command, 0.3 / speed_mps);
  drive(world, 0, 0, 0.3);
  EXPECT_GT(sense * world.pose().x_m, 0.25) << "it has crossed";
  const double odometry_rad = R * (world.wheel_angle(1) - world.wheel_angle(0)) / robot.wheelbase_m();
  return {world.pose().theta_rad - odometry_rad, world.cost()};
}

TEST(WorldCable, ClosedFormIsThePublishedOne) {
  EXPECT_NEAR(path_gain(0.075, 0.005), 0.003398, 5e-7);
  EXPECT_NEAR(degrees(path_gain(0.075, 0.005) / 0.340), 0.573, 5e-4);
  EXPECT_NEAR(path_gain(0.042, 0.005), 0.004496, 5e-7);
  EXPECT_NEAR(degrees(path_gain(0.042, 0.005) / 0.2014), 1.279, 5e-4);
}

// Either wheel, either direction of travel.
void expect_closed_form(const RobotModel& robot, double speed_mps, double friction) {
  const double expected_rad = path_gain(robot.wheels[0].radius_m, 0.005) / robot.wheelbase_m();
  for (const int sense : {1, -1}) {
    const Crossing left = cross(robot, 0, sense, speed_mps, {}, 0.010, friction);
    const Crossing right = cross(robot, 1, sense, speed_mps, {}, 0.010, friction);
    // Driving forward, a bumped left wheel lags: the robot turns left. Driving backward the other way.
    const double magnitude_rad = sense * left.heading_error_rad;
    std::cout << "R " << robot.wheels[0].radius_m << ", friction " << friction << ", " << sense * speed_mps
              << " m/s: left " << degrees(left.heading_error_rad) << " deg, right " << degrees(right.heading_error_rad)
              << " deg (" << degrees(expected_rad) << ", " << 100 * (magnitude_rad / expected_rad - 1)
              << " %), solver fallbacks " << left.cost.solver_fallbacks + right.cost.solver_fallbacks << "\n";
    EXPECT_NEAR(magnitude_rad, expected_rad, kModelError * expected_rad) << "speed " << sense * speed_mps;
    EXPECT_NEAR(left.heading_error_rad, -right.heading_error_rad, kCableMirror);
  }
}

TEST(WorldCable, LabmateTurnsByTheClosedForm) {
  for (const double speed_mps : {0.05, 0.1, 0.2}) expect_closed_form(labmate(), speed_mps, 0.9);
}

// The small wheel climbs at psi = 38 degrees, tan psi = 0.78: near the friction limit, so at 0.2 m/s the blow makes it
// slip. The closed form, which knows no slip, holds for slower crossings and for a floor with grip.
TEST(WorldCable, SmallRobotTurnsByTheClosedForm) {
  for (const double speed_mps : {0.05, 0.1}) expect_closed_form(small_robot(), speed_mps, 0.9);
  expect_closed_form(small_robot(), 0.2, 2);
}

TEST(WorldCable, HalvingTheFineStepShrinksTheError) {
  const auto at = [](double fine_step_s) {
    PhysicsOptions options;
    options.fine_step_s = fine_step_s;
    return cross(labmate(), 0, 1, 0.1, options).heading_error_rad;
  };
  const double reference_rad = at(0.02 / 320);
  double last_rad = 0;
  for (const double step_s : {0.004, 0.001, 0.00025}) {
    const double error_rad = std::abs(at(step_s) - reference_rad);
    std::cout << "fine step " << step_s << " s: " << degrees(error_rad) << " deg off\n";
    if (last_rad > 0) {
      EXPECT_LT(error_rad, last_rad);
    }
    last_rad = error_rad;
  }
}

// A tread that gives takes its static sink off the cable's height: the closed form of h - sink. (That is how a rigid
// wheel's 0.573 degrees and the 0.44 degrees that the lecture quotes for a real tyre go together.)
TEST(WorldCable, TheTreadsSinkLowersTheCable) {
  constexpr double kDynamics = 0.01;  // the climb's blow at 0.1 m/s, and the finite step
  for (const double sink_m : {0.00005, 0.0001, 0.0002}) {
    double last_rad = 0;
    for (const double height_m : {0.004, 0.007, 0.010}) {
      PhysicsOptions options;
      options.softness.static_sink_m = sink_m;
      const double error_rad = cross(labmate(), 0, 1, 0.1, options, height_m).heading_error_rad;
      const double expected_rad = path_gain(0.075, (height_m - sink_m) / 2) / 0.340;
      std::cout << "sink " << sink_m << " m, cable " << height_m << " m: " << degrees(error_rad) << " deg ("
                << degrees(expected_rad) << ", " << 100 * (error_rad / expected_rad - 1) << " %)\n";
      EXPECT_NEAR(error_rad, expected_rad, kDynamics * expected_rad);
      EXPECT_GT(error_rad, last_rad);
      last_rad = error_rad;
    }
  }
}

TEST(WorldCable, BesideTheWheelItDoesNothing) {
  World bare = placed(labmate()), with_cable = placed(labmate());
  Cable cable;
  cable.x_m = 0.15;
  cable.y_m = 0.17 + 0.05;  // 80 mm long: it ends 10 mm beside the wheel
  with_cable.lay_cable(cable);
  drive(bare, 1, 1, 4);
  drive(with_cable, 1, 1, 4);
  EXPECT_NEAR(with_cable.pose().theta_rad, bare.pose().theta_rad, kCableMirror);
  EXPECT_NEAR(with_cable.wheel_centre(0).z(), 0.075, 1e-6);
}

}  // namespace
}  // namespace umbsim
