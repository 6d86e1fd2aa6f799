#pragma once

#include "calibration/methods/fit.h"

namespace umbsim::calibration {

/// Bidirectional circular path test, after Abbas, Arif & Ahmed (2006), "Measurement and correction of systematic
/// odometry errors caused by kinematics imperfections in mobile robots": circles of both directions. On a steady circle
/// the wheels' ways l and r turn the robot by psi on the radius rho:
///   c_R r - c_L l = b psi,   (c_R r + c_L l) / 2 = rho psi.
/// rho and psi are those of the circle through the tracked positions, so that neither the tracker's headings nor the
/// start pose matter. With end points only, psi is the tracked turn and the mean radius stays as it is.
Fit fit_circles(const Runs& runs, const OdometryParameters& nominal);

}  // namespace umbsim::calibration
