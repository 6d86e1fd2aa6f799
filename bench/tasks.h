#pragma once

#include "bench/engine.h"

namespace umbsim::bench {

/// How one engine did on one task.
struct Outcome {
  double error = 0;          ///< metres (square) or ratio to the closed form (cable)
  double heading_error_rad = 0;
  double simulated_s = 0;
  double wall_s = 0;
  double steps = 0;
  double speed() const { return simulated_s / wall_s; }
  double us_per_step() const { return 1e6 * wall_s / steps; }
};

/// The 4 m square cw, closed-loop on odometry of a million ticks: return error, position and heading.
Outcome drive_square(Engine& engine, const RobotModel& nominal);

/// 1.4 m straight over the cable of `setup`: heading error as a ratio to the closed form of a rigid wheel.
Outcome cross_cable(Engine& engine, const RobotModel& nominal, double cable_height_m, double speed_mps);

/// Heading change of a rigid wheel that rolls over a round cable without slip, radians.
double cable_heading_rad(double radius_m, double wheelbase_m, double cable_height_m);

}  // namespace umbsim::bench
