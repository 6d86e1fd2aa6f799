#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/worlds/checks/drive_course.h"
#include "bench/worlds/checks/robots.h"

namespace umbsim::worlds {

/// How far engines lead a robot astray from its counts where nothing is wrong: the floor below which a diagnosis with
/// one engine's model cannot see in another engine's recordings.

/// What a drive is like.
struct Condition {
  Size size = Size::middle;
  double speed_mps = 0.2;
  double payload_share = 0;  ///< of the robot's mass
};

/// Truth less what the same counts add up to, over one part of a course in the frame of the part's start: metres along
/// and across, radians.
struct PartResidual {
  std::string part;  ///< as drive_course.h
  Condition condition;
  double length_m = 0;
  double angle_rad = 0;
  Pose2 residual;
};

/// All parts of squares, squares with arcs and circles, both ways round, in all conditions, with options that are drawn
/// anew for each of `draws`. Options with which a robot does not stand or drive are left out; `refused` counts them.
std::vector<PartResidual> residuals_of(const EngineKind& kind, int draws, std::uint64_t seed, int& refused);

/// Root mean square over all draws of two engines' options, parts of this kind and conditions.
struct Difference {
  double along_m = 0;
  double across_m = 0;
  double heading_rad = 0;
  double heading_share = 0;  ///< of the part's turn; 0 where it has none
};

/// Of one engine's drives against the other's. Both with the same conditions in the same order.
Difference difference(const std::vector<PartResidual>& a, const std::vector<PartResidual>& b);

}  // namespace umbsim::worlds
