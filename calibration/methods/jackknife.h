#pragma once

#include <functional>

#include "calibration/methods/fit.h"

namespace umbsim::calibration {

using FitFunction = std::function<Fit(const Runs&, const OdometryParameters&)>;

/// Fits, and takes the covariance from how the answer moves when one run is left out and the other runs of its
/// condition and direction stand for it: the jackknife of stratified samples (Wolter 2007, "Introduction to Variance
/// Estimation", section 4.5). Exact for what is linear in means over the runs of a condition, and for least squares
/// over all runs together, too: the balance of cw and ccw stays. Without a repeated run there is no interval.
Fit with_interval(const FitFunction& fit, const Runs& runs, const OdometryParameters& nominal);

/// The runs without the one, whose weight those of its condition share.
Runs without_run(const Runs& runs, std::size_t left_out);

/// The same from the answers that were found with each run left out so. `left_out[i]` belongs to `runs[i]`; of
/// conditions with one run it need not be there.
void set_interval(Fit& fit, const Runs& runs, std::vector<std::optional<LogFactors>> left_out);

}  // namespace umbsim::calibration
