#pragma once

#include "calibration/compare/compare.h"
#include "experiment/output/result_json.h"

namespace umbsim {

/// What a comparison adds to calibration.json: methods, errors on every recording, parts of the course, the winner.
Json comparison_json(const calibration::Comparison& comparison, const calibration::Task& task);

/// The course of every run and what dead reckoning misses of it, before and after, at a hundred moments of each.
Json residuals_json(const calibration::Comparison& comparison, const calibration::Task& task);

/// Return errors of every run of squares, before and after.
Json squares_json(const calibration::Comparison& comparison, const calibration::Task& task);

}  // namespace umbsim
