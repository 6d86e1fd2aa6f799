#pragma once

#include "gap/noise/nuisances.h"

namespace umbsim::gap {

/// A tracker's heading that is off the drive axis looks like toe, so it must be known how the tracker was mounted.
/// Keeps the priors with trackers that are exact, as a simulator's truth is, or those with trackers mounted by hand,
/// whichever is likelier by two things that little else moves: the point that is tracked (`mean`: of all shared
/// numbers, fitted with trackers mounted by hand), and how far from the course's start the first readings are. Where
/// both kinds of priors are there: `n.markers` is not empty. `noise`: of each run.
void settle_trackers(Nuisances& n, const NominalReplay& nominal, const std::vector<NoiseModel>& noise,
                     const Scatter& scatter, const Eigen::VectorXd& mean);

}  // namespace umbsim::gap
