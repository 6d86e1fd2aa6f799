#pragma once

#include "gap/answer/diagnosis.h"

namespace umbsim::gap {

/// Whether the evidence against a fit goes with the turns, the legs or one run.
LeftOver describe_left_over(const Model& model, const Fit& fit);

/// Stage, pattern and place of the best fit, and the segments of the course that speak against no effect.
void say_where(const Model& model, const Fit& none, const Fit& best, Diagnosis& d);

}  // namespace umbsim::gap
