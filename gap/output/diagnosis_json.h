#pragma once

#include <nlohmann/json.hpp>

#include "gap/answer/diagnosis.h"

namespace umbsim::gap {

/// diagnosis.json (format umbsim-diagnosis/1). `verdict`, `cost` and `next_experiment` are added by the caller.
nlohmann::ordered_json diagnosis_json(const Diagnosis& diagnosis);

}  // namespace umbsim::gap
