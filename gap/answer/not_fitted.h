#pragma once

#include <optional>
#include <vector>

#include "gap/answer/diagnosis.h"
#include "gap/search/thresholds.h"

namespace umbsim::gap {

/// What the best explanation leaves may be an uneven floor: that floor, with the explanation if it is worth keeping
/// beside it. `lack`: log evidence of the misfit that the explanation leaves.
std::optional<Fit> with_uneven_floor(const Model& model, const Fit& none, const Fit& best, double lack,
                                     const Thresholds& thresholds);

/// A commanded motion beyond the course that commands plainly show is the cause, whatever the tyres make of it: when
/// they let go under a jolt differs from engine to engine, and from tyre to tyre. `generic_none`: what errors of no
/// particular cause gain without any effect.
std::optional<Fit> shown_commanded_motion(const Model& model, const std::vector<Cause>& causes, const Fit& none,
                                          double generic_none, const Thresholds& thresholds);

}  // namespace umbsim::gap
