#pragma once

#include "gap/noise/track_filter.h"
#include "gap/replay/nominal_replay.h"

namespace umbsim::gap {

/// The noise that stays however well runs repeat, for nothing that is recorded shows less: half a tick, how a wheel
/// sped up between two readings, the last digit of the tracker, and the give of the simulator's own contacts. Runs of a
/// simulation without noise are alike to the last digit; a replay of their counts is not.
/// `reading_s`: interval at which the counters really change.
NoiseModel least_noise(const NominalReplay& nominal, double reading_s);

}  // namespace umbsim::gap
