#pragma once

#include <string>
#include <vector>

#include "bench/fidelity/robots.h"

namespace umbsim::fidelity {

enum class Drive { square, cable, uneven_floor, swivelling_caster, braking_slide };

/// One drive with one step.
struct StepRun {
  double step_s = 0;
  double off_m = 0;    ///< from the same drive with the reference step; the square: from exact kinematics
  double off_rad = 0;
};
struct Convergence {
  std::vector<StepRun> runs;  ///< longest step first
  double reference_s = 0;     ///< 0: exact kinematics
  double order = 0;           ///< slope of log(off_m) over log(step), first to last run
};
Convergence converge(Drive drive, Grid grid);

std::string steps_chapter(Grid grid);

}  // namespace umbsim::fidelity
