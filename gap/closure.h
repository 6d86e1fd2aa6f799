#pragma once

#include "gap/diagnose.h"

namespace umbsim::gap {

/// Predicts every condition in the simulator with parameters fitted on the other conditions, and compares the tracks
/// with what was recorded. The start pose of each run is aligned alike before and after.
Closure held_out_closure(const Model& model, const Fit& fit);

/// Mean square position error of simulated tracks against the recorded ones, start poses aligned, m^2.
double mean_square_error_m2(const Model& model, const std::vector<std::vector<Pose2>>& tracks);

}  // namespace umbsim::gap
