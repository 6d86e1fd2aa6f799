#pragma once

#include <string>
#include <vector>

#include "recording/recording.h"

namespace umbsim::intake {

/// Looks a recording over before anything is measured on it. Throws InputError that names file or run, what is wrong
/// with it and what to do: no motion, counts that jump, wheels swapped or reversed, units off by a power of ten,
/// degrees for radians, radians for counts, a truth with gaps. Returns what limits the answer without making it wrong
/// (one run only, one direction only, end points only, no replicates), in words.
std::vector<std::string> check_recording(const Recording& recording, const std::string& directory);

/// A recording that can be measured on, and what limits the answer, in words.
struct Intake {
  Recording recording;
  std::vector<std::string> limits;
};

/// Reads, unwraps counters that wrap at 16 or 32 bits, checks, and keeps at most 100 readings of the encoders a second:
/// the one way by which a recording comes to calibration and to diagnosis. Throws InputError.
Intake take_in(const std::string& directory);

}  // namespace umbsim::intake
