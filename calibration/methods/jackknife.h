#pragma once

#include <functional>

#include "calibration/methods/fit.h"

namespace umbsim::calibration {

using FitFunction = std::function<Fit(const Runs&, const OdometryParameters&)>;

/// Fits, and takes covariance and degrees of freedom from how the answer moves when one run is left out: the stratified
/// jackknife (Efron & Tibshirani 1993, ch. 11), with conditions as strata and Satterthwaite's degrees of freedom. Exact
/// for methods that are linear in means over runs. Without a repeated run there is no interval.
Fit with_interval(const FitFunction& fit, const Runs& runs, const OdometryParameters& nominal);

/// The same from the answers that were found with each run left out. `left_out[i]` belongs to `runs[i]`; of strata
/// with one run it need not be there.
void set_interval(Fit& fit, const Runs& runs, std::vector<std::optional<LogFactors>> left_out);

}  // namespace umbsim::calibration
