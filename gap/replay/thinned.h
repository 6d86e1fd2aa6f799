#pragma once

#include "recording/recording.h"

namespace umbsim::gap {

/// The recording with at most `most_hz` > 0 readings of the truth per second: every n-th of a run's, from its first one
/// on, and its last one. n is the same along the run. Encoders and end points stay as they are.
Recording thinned(Recording recording, double most_hz);

}  // namespace umbsim::gap
