#pragma once

#include "gap/noise/track_filter.h"
#include "gap/replay/nominal_replay.h"

namespace umbsim::gap {

/// Mean over a run of the variance of position that noise makes, with the start known, m^2.
double noise_floor_m2(const NominalReplay& nominal, const NoiseModel& noise, std::size_t run);

/// Root mean square position error that the run-to-run noise alone makes along all runs, metres. `noise`: of each run.
double noise_floor_m(const NominalReplay& nominal, const std::vector<NoiseModel>& noise);

/// Root mean square displacement between two sets of tracks, metres.
double displacement_m(const std::vector<std::vector<Pose2>>& a, const std::vector<std::vector<Pose2>>& b);

}  // namespace umbsim::gap
