#pragma once

#include "recording/recording.h"

namespace umbsim::intake {

/// The recording with at most `most_hz` > 0 readings of the truth per second: every n-th of a run's, from its first one
/// on, and its last one. n is the same along the run. Encoders and end points stay as they are.
Recording thinned_truth(Recording recording, double most_hz);

/// The recording with at most `most_hz` > 0 readings of the encoders per second, as above but by the declared rate,
/// which becomes that of what is left. Counts are sums, so that none is lost; commands are those of the readings that
/// are left. The truth stays as it is.
Recording thinned_counts(Recording recording, double most_hz);

}  // namespace umbsim::intake
