#pragma once

#include "gap/answer/diagnosis.h"

namespace umbsim::gap {

/// What noise, and what engines differ by if `other_engine`, make tracks of no effect stray by more than once in twenty
/// times: root mean square position error along the runs.
double most_hidden_mm(const Model& model, bool other_engine = true);

/// Predicts every condition in the simulator with parameters fitted on the other conditions, and compares the tracks
/// with what was recorded. The start pose of each run is aligned alike before and after.
Closure held_out_closure(const Model& model, const Fit& fit);

}  // namespace umbsim::gap
