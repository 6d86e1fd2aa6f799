#pragma once

#include <optional>
#include <set>
#include <string>

#include "gap/answer/diagnosis.h"
#include "gap/search/search.h"

namespace umbsim::gap {

/// Radii and wheelbase that stand for what the twin leaves: as a calibration finds them, whatever the cause. A contact
/// that is wider than it should be scrubs otherwise in another engine than here; a longer wheelbase foretells much of
/// that. Beside the twin's causes, or if they foretell less of held-out runs in their place; `closure`: of these
/// causes. None where the dimensions take off less than they leave (mean squares).
/// A real robot's twin also scrubs (scrub_hypothesis) where that brings held-out runs nearer.
std::optional<EffectiveTwin> effective_twin(const Model& model, const Screen& screen,
                                            const std::set<std::string>& excluded, const Fit& none, const Fit& twin,
                                            const Closure& closure);

}  // namespace umbsim::gap
