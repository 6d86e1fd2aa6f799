#pragma once

#include <vector>

#include "calibration/methods/fit.h"

namespace umbsim::calibration {

/// Scale of the half-normal belief in scrub before the data. A tyre's contact of width w under the load N resists turning
/// by mu N w / 4, its partner likewise: a force of mu N w / (2 b) along each tyre. Creep is this over the tyre's stiffness,
/// some 20 N per unit: for w = b / 20 and mu = 0.8 a share of 0.001.
constexpr double kUsualScrub = 0.001;

/// What a fit with the Gaussian belief N(0, kUsualScrub^2) says of scrub.
struct ScrubFit {
  double value = 0;
  double variance = 0;             ///< by the noise model
  Eigen::Vector3d factor_slope;    ///< of the other factors, where scrub is held elsewhere
  std::vector<double> left_out;    ///< without each run
};

/// Scrub opposes turning, so that it is no less than 0: its posterior is a Gaussian that is cut there. The mean of it, not
/// its peak: where the runs do not tell scrub from the wheelbase, the usual scrub remains. The data's variance is the
/// larger of the noise model's and the jackknife's. Moves the fit's factors, its answers without each run and its
/// covariance to that scrub.
void believe(const ScrubFit& said, const Runs& runs, Fit& fit);

}  // namespace umbsim::calibration
