#pragma once

#include <string>
#include <vector>

#include "recording/recording.h"

namespace umbsim::gap {

/// Looks a recording over before anything is fitted. Throws InputError that names file or run, what is wrong with it
/// and what to do: no motion, counts that jump, wheels swapped or reversed, units off by a power of ten, degrees for
/// radians, radians for counts, a truth with gaps. Returns what limits the answer without making it wrong (one run
/// only, one direction only, end points only, no replicates), in words.
std::vector<std::string> check_recording(const Recording& recording, const std::string& directory);

/// Moments between two end points, so that a run can be followed through; the poses there stand for nothing.
Recording with_moments_between(Recording recording);

}  // namespace umbsim::gap
