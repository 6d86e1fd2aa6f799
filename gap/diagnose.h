#pragma once

#include <set>
#include <string>

#include "gap/answer/diagnosis.h"
#include "gap/search/thresholds.h"

namespace umbsim::gap {

/// Diagnoses a recording. `excluded`: effects taken out of the catalogue. Where the runs are likelier another engine's,
/// whatever is wrong, they are diagnosed again as that, and the model is taken for another engine's if that answer
/// stands. Throws InputError, RunError.
Diagnosis diagnose(Model& model, const std::set<std::string>& excluded, const Thresholds& thresholds,
                   const ProgressCallback& progress);

}  // namespace umbsim::gap
