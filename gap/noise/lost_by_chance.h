#pragma once

#include "effects/catalogue.h"
#include "gap/noise/track_filter.h"
#include "gap/replay/nominal_replay.h"

namespace umbsim::gap {

/// The least noise that runs show whose counts get lost by chance. Of n counts, each lost with probability p, the
/// number lost has variance n p (1 - p): where the mean is made up for, what a wheel rolls is off by a random walk of
/// p (1 - p) times the way of one count, per metre, and both wheels' walks move heading and distance. Only
/// `heading_rad2_pm` and `along_m2_pm` are filled; 0 where no counts get lost.
NoiseModel lost_by_chance(const NominalReplay& nominal, const std::vector<Effect>& effects);

}  // namespace umbsim::gap
