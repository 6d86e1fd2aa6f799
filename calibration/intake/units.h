#pragma once

#include <string>

#include "recording/recording.h"

namespace umbsim::intake {

/// Wheels against tracker, for a recording with tracks: nothing that moves, one wheel's counter dead, wheels exchanged
/// or reversed, a truth that is mirrored, counts, lengths and angles in other units. Throws InputError.
void check_scale(const std::string& directory, const RecordedRun& run, const Recording& recording);

/// The same as far as start and end tell, and a square its side. Throws InputError.
void check_end_points(const std::string& directory, const RecordedRun& run, const Recording& recording);

/// Commands in other units than rad/s, exchanged, reversed, or none. Throws InputError.
void check_commands(const std::string& directory, const RecordedRun& run, const RecordedRobot& robot);

/// The run against what recording.yaml says of it: direction, side and speed. Throws InputError.
void check_path(const std::string& directory, const RecordedRun& run, const Recording& recording);

}  // namespace umbsim::intake
