#pragma once

#include <cmath>

#include "sim/world.h"

namespace umbsim::testing {

constexpr double kG = 9.81;

/// A robot of round numbers: R 75 mm, b 340 mm, 40 kg whose centre is 60 mm ahead of the axle, 1 kg wheels, a
/// frictionless ball 250 mm ahead.
inline RobotModel labmate(double radius_m = 0.075, double wheelbase_m = 0.340) {
  RobotModel robot;
  robot.name = robot.urdf = "test robot";
  robot.base = {40, {0.06, 0, 0.05}, Eigen::Vector3d(0.9, 0.9, 1.4).asDiagonal()};
  for (int i = 0; i < 2; ++i) {
    Wheel& wheel = robot.wheels[i];
    wheel.centre_m = {0, (i == 0 ? 1 : -1) * wheelbase_m / 2, 0};
    wheel.radius_m = radius_m;
    wheel.mass_kg = 1;
    wheel.spin_inertia_kgm2 = radius_m * radius_m / 2;
    wheel.transverse_inertia_kgm2 = radius_m * radius_m / 4;
  }
  Caster ball;
  ball.link = "ball";
  ball.radius_m = 0.03;
  ball.centre_m = {0.25, 0, ball.radius_m - radius_m};
  robot.casters = {ball};
  return robot;
}

/// The optiodom robot's proportions: 4 kg, R 42 mm, b 201.4 mm, a ball 100 mm ahead.
inline RobotModel small_robot() {
  RobotModel robot = labmate(0.042, 0.2014);
  robot.base = {4, {0.03, 0, 0.02}, Eigen::Vector3d(0.02, 0.02, 0.03).asDiagonal()};
  for (Wheel& wheel : robot.wheels) {
    wheel.mass_kg = 0.1;
    wheel.spin_inertia_kgm2 = 0.1 * 0.042 * 0.042 / 2;
    wheel.transverse_inertia_kgm2 = wheel.spin_inertia_kgm2 / 2;
  }
  robot.casters[0].centre_m.x() = 0.1;
  robot.casters[0].radius_m = 0.01;
  robot.casters[0].centre_m.z() = 0.01 - 0.042;
  return robot;
}

/// The robot seen in a mirror: left and right change places.
inline RobotModel mirrored(RobotModel robot) {
  const Eigen::Matrix3d flip = Eigen::Vector3d(1, -1, 1).asDiagonal();
  std::swap(robot.wheels[0], robot.wheels[1]);
  robot.base.com_m.y() *= -1;
  robot.base.inertia_kgm2 = (flip * robot.base.inertia_kgm2 * flip).eval();
  for (Wheel& wheel : robot.wheels) wheel.centre_m.y() *= -1;
  for (Caster& caster : robot.casters) caster.centre_m.y() *= -1;
  return robot;
}

inline PhysicsOptions rigid() {
  PhysicsOptions options;
  options.softness.static_sink_m = 0;
  return options;
}

inline World placed(const RobotModel& robot, const Floor& floor = {}, const PhysicsOptions& options = {},
                    double torque_limit_nm = 20) {
  World world(robot, {torque_limit_nm}, floor, options);
  world.place({});
  return world;
}

/// Control periods of 20 ms at one command.
inline void drive(World& world, double left_radps, double right_radps, double seconds) {
  for (int i = 0; i < std::lround(seconds / 0.02); ++i) {
    world.command(left_radps, right_radps);
    world.advance(0.02);
  }
}

/// To a speed, along it, and back to rest, with ramps of one second, as a driver does.
inline void trip(World& world, double left_radps, double right_radps, double seconds) {
  for (int i = 1; i <= 50; ++i) drive(world, left_radps * i / 50, right_radps * i / 50, 0.02);
  drive(world, left_radps, right_radps, seconds);
  for (int i = 49; i >= 0; --i) drive(world, left_radps * i / 50, right_radps * i / 50, 0.02);
  drive(world, 0, 0, 0.4);
}

}  // namespace umbsim::testing
