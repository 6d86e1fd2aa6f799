#pragma once

#include <string>

#include "calibration/compare/compare.h"

namespace umbsim {

/// All methods beside each other, within 80 columns: parameters with intervals, errors on every recording, parts of the
/// course, warnings, the winner.
std::string comparison_table(const calibration::Comparison& comparison, const calibration::Task& task);

}  // namespace umbsim
