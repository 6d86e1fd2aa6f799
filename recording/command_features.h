#pragma once

#include <array>

#include "recording/recording.h"
#include "recording/stretches.h"

namespace umbsim {

/// How the robot was driven and read, against what the recording declares. Natural logarithms of ratios, 0 where it is
/// as declared: linear acceleration, angular acceleration, speed of turns in place, sampling interval over the reading
/// period, counts per revolution really resolved over those declared.
using CommandFeatures = std::array<double, 5>;

/// From commands where there are some (else from counts). What the recording does not declare is 0.
/// `count_step`: width of the encoders' steps, in counts.
CommandFeatures measured_command_features(const Recording& recording,
                                          const std::vector<std::vector<Stretch>>& stretches, double count_step);

}  // namespace umbsim
