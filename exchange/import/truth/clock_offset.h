#pragma once

#include <optional>
#include <string>

#include "recording/recording.h"

namespace umbsim::exchange {

/// How the truth's clock stands to the encoders'.
struct ClockOffset {
  double add_s = 0;        ///< to the truth's times, so that both turn at the same time
  double correlation = 0;  ///< of the turning speeds then
};

/// From the turning speeds of wheels and truth, at all shifts within `most_s` about `about_s`; to 1 ms. Nothing where
/// neither turns.
std::optional<ClockOffset> clock_offset(const RecordedRun& run, const RecordedRobot& robot, double about_s,
                                        double most_s);

/// What to say of logs that do not overlap: the shift that would make them turn together.
std::string offset_hint(const RecordedRun& run, const RecordedRobot& robot, double already_s);

}  // namespace umbsim::exchange
