#pragma once

#include <set>
#include <string>

#include "gap/answer/diagnosis.h"
#include "gap/search/thresholds.h"

namespace umbsim::gap {

/// Diagnoses a recording. `excluded`: effects taken out of the catalogue. Throws InputError, RunError.
Diagnosis diagnose(const Model& model, const std::set<std::string>& excluded, const Thresholds& thresholds,
                   const ProgressCallback& progress);

}  // namespace umbsim::gap
