#pragma once

#include <optional>

#include "gap/answer/diagnosis.h"
#include "gap/search/search.h"

namespace umbsim::gap {

/// Radii and wheelbase that stand for what the twin leaves: as a calibration finds them, whatever the cause. A contact
/// that is wider than it should be scrubs otherwise in another engine than here; a longer wheelbase foretells much of
/// that. Beside the twin's causes, or if they foretell less of held-out runs in their place; `closure`: of these
/// causes, known. None where the dimensions take off less than they leave (mean squares).
std::optional<EffectiveTwin> effective_twin(const Model& model, const Screen& screen, const Fit& none, const Fit& twin,
                                            const Closure& closure);

}  // namespace umbsim::gap
