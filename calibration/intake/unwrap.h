#pragma once

#include <string>
#include <vector>

#include "recording/recording.h"

namespace umbsim::intake {

/// Counters that wrap at 16 or 32 bits, unwrapped. All counts of a wheel must lie within that range, and with it added
/// or taken away the step must be one that this wheel usually makes. Returns what was done, in words, one a run.
std::vector<std::string> unwrap_counters(Recording& recording);

}  // namespace umbsim::intake
