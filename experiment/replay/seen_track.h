#pragma once

#include <cstddef>
#include <vector>

#include "core/pose2.h"
#include "recording/recording.h"

namespace umbsim {

/// Where a tracker saw a robot whose replay goes along `track`, a pose at each of the encoders' samples: for every
/// `every`-th sample X with X * track[sample] the pose of the axle's middle then, by the readings of the half second
/// before. A clock ahead of the encoders' and an offset of the tracked point, which are estimated from the run
/// (least squares, single readings capped), do not count as ways off. Empty where the recording has no track.
std::vector<Pose2> seen_beside(const RecordedRun& run, const std::vector<Pose2>& track, std::size_t every);

}  // namespace umbsim
