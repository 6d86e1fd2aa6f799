#pragma once

#include <string>
#include <vector>

#include "recording/recording.h"

namespace umbsim::gap {

/// How the tracker's clock stands to the encoders': encoder time = truth time + offset + rate * truth time.
struct ClockFit {
  double offset_s = 0;
  double rate = 0;
  double offset_sd_s = 0;
  double rate_sd = 0;
};

/// From one run: where the encoders say the robot turns, the truth must turn. Robust least squares of the truth's
/// heading on the odometry's at the shifted time, a constant, a scale of turns and a drift with the way.
ClockFit fit_clock(const RecordedRun& run, const RecordedRobot& robot);

struct ClocksAligned {
  Recording recording;
  double most_offset_s = 0;  ///< largest that was applied, 0 if none
  double most_rate = 0;
};

/// The recording with the truth's times moved by each run's fit, where that stands out from its own uncertainty;
/// samples that then lie outside the encoders' time are left out.
ClocksAligned with_clocks_aligned(Recording recording);

/// Moments between two end points, so that a run can be followed through; the poses there stand for nothing.
Recording with_moments_between(Recording recording);

/// What a diagnosis or a plan follows through: with moments between end points, and with a real tracker's clock set to
/// the encoders', which `limits` then says.
Recording followed_through(const Recording& given, std::vector<std::string>& limits);

}  // namespace umbsim::gap
