#pragma once

#include <Eigen/Core>

#include "sim/model/floor.h"

namespace umbsim::worlds::planar {

/// Where the centre of something round is carried over a place of the floor.
struct Carried {
  double height_m = 0;                              ///< above where level floor carries it
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();  ///< of the way of the centre, floor frame
};

/// The centre of a wheel or ball of `radius_m` above the place: over ripples, or on the arc on which it climbs a round
/// cable, whichever is higher. A centre whose way is taken for the rolled distance gives the closed form of a cable.
Carried carried(const Floor& floor, const Eigen::Vector2d& place_m, double radius_m);

}  // namespace umbsim::worlds::planar
