#pragma once

#include "calibration/methods/fit.h"
#include "umbmark/figures.h"

namespace umbsim::calibration {

/// UMBmark, Borenstein & Feng (1996), "Measurement and correction of systematic odometry errors in mobile robots":
/// alpha and beta from the return positions of closed squares driven both ways, small angles.
Fit fit_endpoint(const Runs& runs, const OdometryParameters& nominal);

/// The same, repeated on the recorded ticks with the corrected odometry until nothing is left to correct: no
/// small-angle bias remains. (A second pass of the test, without driving it.)
Fit fit_iterated_endpoint(const Runs& runs, const OdometryParameters& nominal);

/// Heading form, after Jung & Chung (2011), "Calibration of kinematic parameters for two wheel differential mobile
/// robots": alpha and beta from the return headings, exact.
Fit fit_heading(const Runs& runs, const OdometryParameters& nominal);

/// Return errors of all square runs of one recording, by `odometry`; empty without both directions.
std::optional<Umbmark> squares_of(const Runs& runs, std::size_t recording_index, const OdometryParameters& odometry);

}  // namespace umbsim::calibration
