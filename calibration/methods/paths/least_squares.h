#pragma once

#include "calibration/methods/fit.h"

namespace umbsim::calibration {

/// Least squares on any paths: Antonelli, Chiaverini & Fusco (2005), "A calibration method for odometry of mobile
/// robots based on the least-squares technique", in the physical parameters of Antonelli & Chiaverini (2007), "Linear
/// estimation of the physical odometric parameters for differential-drive mobile robots". Linear in two steps: headings
/// give c_R / b and c_L / b, positions then give b. Takes tracked headings and clocks as exact.
Fit fit_least_squares(const Runs& runs, const OdometryParameters& nominal);

}  // namespace umbsim::calibration
