#pragma once

#include "calibration/compare/compare.h"
#include "experiment/result_json.h"

namespace umbsim {

/// What a comparison adds to calibration.json: methods, errors on every recording, parts of the course, the winner.
Json comparison_json(const calibration::Comparison& comparison, const calibration::Task& task);

}  // namespace umbsim
