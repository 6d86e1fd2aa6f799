#pragma once

#include "gap/answer/diagnosis.h"

namespace umbsim::gap {

/// Predicts every condition in the simulator with parameters fitted on the other conditions, and compares the tracks
/// with what was recorded. The start pose of each run is aligned alike before and after.
Closure held_out_closure(const Model& model, const Fit& fit);

}  // namespace umbsim::gap
