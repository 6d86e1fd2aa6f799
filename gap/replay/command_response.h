#pragma once

#include <array>
#include <vector>

#include "recording/recording.h"

namespace umbsim::gap {

/// Counts against commands of one run: what the drivetrain and the encoders make of what was asked.
struct CommandResponse {
  bool known = false;
  double left_gain = 0;  ///< counted over commanded rotation, minus 1
  double right_gain = 0;
  double lag_s = 0;    ///< of the counts behind the commands
  double gain_sd = 0;  ///< of the gains, from the width of the encoder's steps
};

/// `counts_rad`: angles (left, right) at the encoder samples of a run with commands. `step_rad`: between
/// two counts, as wide as they really are.
CommandResponse command_response(const RecordedRun& run, const std::vector<std::array<double, 2>>& counts_rad,
                                 double step_rad);

/// The recorded counts as angles.
std::vector<std::array<double, 2>> counted_rad(const RecordedRun& run, const RecordedRobot& robot);

}  // namespace umbsim::gap
