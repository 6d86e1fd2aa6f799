#pragma once

#include "calibration/methods/fit.h"

namespace umbsim::calibration {

/// Maximum likelihood on whole tracks. Every run is dead reckoning from an unknown start pose, its error a random walk
/// of both wheels (k sqrt(s), Chong & Kleeman 1997), seen by a tracker with white noise through a frame that is turned
/// against the robot, a marker beside the axle's middle and a clock of its own. Innovations of a Kalman filter over the
/// error are the residuals that Ceres makes least; noise levels follow by maximising the same likelihood. The interval
/// is the jackknife's over runs (one step of Newton each), the model's own where no run was repeated.
Fit fit_likelihood(const Runs& runs, const OdometryParameters& nominal);

/// The same with scrub (`over_floor` in odometry/dead_reckoning.h) beside radii and wheelbase: what takes from turns in
/// place a share, and from arcs of radius R 2R/b times as much. Friction opposes turning, so that scrub is no less than 0.
Fit fit_scrub(const Runs& runs, const OdometryParameters& nominal);

}  // namespace umbsim::calibration
