#pragma once

#include <string>
#include <vector>

#include "bench/fidelity/robots.h"
#include "core/pose2.h"

namespace umbsim::fidelity {

/// One cable under one wheel, driven over straight on.
struct CableCase {
  RobotModel robot;
  std::string name;
  double height_m = 0.010;
  double friction = 0.9;
  double speed_mps = 0.2;
  int wheel = 0;  ///< 0 left, 1 right
  PhysicsOptions options;
};

struct CableOutcome {
  bool crossed = false;
  double heading_rad = 0;  ///< that the odometry does not see, towards the bumped wheel
  double ratio = 0;        ///< to the closed form
  Pose2 X_WB;              ///< at the end
  std::int64_t solver_fallbacks = 0;
  double simulated_s = 0;
};
CableOutcome cross(const CableCase& c);

/// Closed form of a rigid wheel on a round cable.
struct Climb {
  double extra_path_m = 0;
  double least_friction = 0;  ///< tan psi
};
Climb closed_form(double radius_m, double cable_height_m);

/// The limit in which the closed form is meant: supports that sink by a share of the cable's height, slow, fine steps.
CableCase in_rigid_limit(CableCase c, double sink_share = 0.01);

/// Robots, heights and frictions at the default settings, left wheel.
std::vector<CableCase> cable_grid(Grid grid);

std::string cable_chapter(Grid grid);

}  // namespace umbsim::fidelity
