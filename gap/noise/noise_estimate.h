#pragma once

#include <functional>

#include "gap/noise/track_filter.h"
#include "gap/replay/nominal_replay.h"

namespace umbsim::gap {

struct NoiseEstimate {
  NoiseModel noise;
  bool replicated = false;  ///< from runs that were repeated; else from what the geometry leaves, or a usual value
  /// Of any other noise, by the differences of repeated runs, in samples that are so long apart that random walks show
  /// whole; empty where it is not from them.
  std::function<double(const NoiseModel&)> log_likelihood;
};

/// The noise of a recording by maximum likelihood, beside a few outliers: from the differences of repeated runs, which
/// no effect touches; where no two runs can be subtracted, from what radii, wheelbase, tracker's frame and clock
/// leave; nowhere below `least` (gap/noise/least_noise.h), whatever repeats say. Of end points, which are few, by
/// maximum a posteriori beside what is usual.
NoiseEstimate estimate_noise(const NominalReplay& nominal, const NoiseModel& least);

}  // namespace umbsim::gap
