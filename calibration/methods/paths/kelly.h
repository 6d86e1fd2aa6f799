#pragma once

#include "calibration/methods/fit.h"

namespace umbsim::calibration {

/// Kelly (2004), "Fast and easy systematic and stochastic odometry calibration", with the path integrals of "Linearized
/// error propagation in odometry": the pose at the end of a path answers linearly to the parameters, its covariance
/// linearly to the variances k_L^2 and k_R^2 of the wheels. Relinearised until it stands still. Each recording's
/// tracker may be turned against the robot; its clock is taken as exact.
Fit fit_kelly(const Runs& runs, const OdometryParameters& nominal);

}  // namespace umbsim::calibration
