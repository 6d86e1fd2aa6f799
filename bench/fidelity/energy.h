#pragma once

#include <string>

#include "bench/fidelity/robots.h"

namespace umbsim::fidelity {

/// A robot with free wheels, pushed and left alone: its energy over its kinetic energy just after the push.
struct Coasting {
  double kinetic_j = 0;
  double kept = 1;      ///< kinetic and potential energy above rest at the end, over kinetic_j
  double path_m = 0;
};
enum class Ground { flat_straight, flat_curve, ridges, uneven, uneven_slippery };
Coasting coast(const RobotModel& robot, Ground ground, const PhysicsOptions& options);

/// Locked wheels sliding straight on to a stop: energy lost over friction times wheel load times distance.
double braking_ratio(const RobotModel& robot, const PhysicsOptions& options);

/// Driven straight up a slope, from rest to rest: energy gained over m g sin(slope) distance.
double climbing_ratio(const RobotModel& robot, double slope_rad, const PhysicsOptions& options);

std::string energy_chapter(Grid grid);

}  // namespace umbsim::fidelity
