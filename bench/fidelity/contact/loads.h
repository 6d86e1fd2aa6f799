#pragma once

#include <string>

#include "bench/fidelity/robots.h"

namespace umbsim::fidelity {

/// Largest difference of any support's load from statics, as a share of the robot's weight.
struct LoadCheck {
  int cases = 0;
  double worst = 0;
};
enum class LoadGrid { centre_of_mass, slope, payload, acceleration };
LoadCheck check_loads(const RobotModel& robot, LoadGrid which, Grid grid, const PhysicsOptions& options);

std::string loads_chapter(Grid grid);

}  // namespace umbsim::fidelity
