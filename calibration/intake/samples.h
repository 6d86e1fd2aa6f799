#pragma once

#include <string>

#include "recording/recording.h"

namespace umbsim::intake {

/// Rows that do not come as often as encoders.rate_hz says, in seconds that are none. Throws InputError.
void check_times(const std::string& directory, const RecordedRun& run, double rate_hz);

/// Counters that jump or overflow, rows of encoders.csv that are missing while the wheels turn. Throws InputError.
void check_counts(const std::string& directory, const RecordedRun& run, const RecordedRobot& robot);

/// Gaps of the truth, and jumps of its heading that the wheels know nothing of. Throws InputError.
void check_truth(const std::string& directory, const RecordedRun& run, const RecordedRobot& robot);

/// Single poses beside the track, and jumps of its place; once its units are right. `position_sd_m`: the tracker's
/// noise. Throws InputError.
void check_places(const std::string& directory, const RecordedRun& run, const RecordedRobot& robot,
                  double position_sd_m);

}  // namespace umbsim::intake
