#pragma once

#include <vector>

#include "gap/evidence/model.h"

namespace umbsim::gap {

/// The hypotheses that can be tried on a model's robot. A step at which it cannot be driven, a load that tips it over
/// for one, is turned round or made smaller, to a 64th at least; a hypothesis without a step that can be driven is left
/// out.
std::vector<Hypothesis> drivable(const Model& model, std::vector<Hypothesis> hypotheses);

}  // namespace umbsim::gap
