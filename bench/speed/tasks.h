#pragma once

#include "bench/speed/engine.h"

namespace umbsim::bench {

constexpr double kCable_m = 0.010;
constexpr double kCableSpeed_mps = 0.2;

/// How one engine did on one task.
struct Outcome {
  double error = 0;              ///< metres (square), or heading as a ratio to the closed form (cable)
  Pose2 return_error;            ///< square: where the robot is, minus where its odometry says
  double heading_error_rad = 0;
  double simulated_s = 0;
  double cpu_s = 0;              ///< time of this thread on a processor
  double steps = 0;
  bool arrived = true;           ///< square: it really turned round once
  double speed() const { return simulated_s / cpu_s; }
  double us_per_step() const { return 1e6 * cpu_s / steps; }
};

/// The robot on a flat floor, with one step length throughout.
Setup flat(const RobotModel& robot, double step_s);

/// The same with one cable across the right wheel's path.
Setup with_cable(const RobotModel& robot, double step_s);

/// The same on an uneven floor: ripples of 0.5 mm root mean square and 0.3 m, as in scenarios/umbmark.yaml.
Setup uneven(const RobotModel& robot, double step_s);

/// A square cw, closed-loop on odometry of a million ticks: return error, position and heading.
Outcome drive_square(Engine& engine, const RobotModel& nominal, double side_m = 4);

/// 1.4 m straight over the cable of `with_cable`: heading error as a ratio to the closed form of a rigid wheel.
Outcome cross_cable(Engine& engine, const RobotModel& nominal);

/// Heading change of a rigid wheel that rolls over a round cable without slip, radians.
double cable_heading_rad(double radius_m, double wheelbase_m, double cable_height_m);

}  // namespace umbsim::bench
