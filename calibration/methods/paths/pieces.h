#pragma once

#include <vector>

#include "calibration/methods/fit.h"
#include "calibration/methods/paths/travel.h"

namespace umbsim::calibration {

/// A part of a run between two absolute poses: what the tracker saw, and what the wheels say of it.
struct Piece {
  const TrainingRun* run = nullptr;
  Pose2 tracked;  ///< end seen from the start
  Travel counted;
};

/// The run cut at `parts` nearly equal steps of its way and turning (one step where there are end points only), and
/// reckoned by `odometry`.
std::vector<Piece> pieces(const TrainingRun& run, const OdometryParameters& odometry, int parts);

/// Of all runs.
std::vector<Piece> pieces(const Runs& runs, const OdometryParameters& odometry, int parts);

/// Condition number of a symmetric matrix of normal equations after scaling its diagonal to one; infinite where it is
/// singular.
double condition_number(const Eigen::MatrixXd& normal);

}  // namespace umbsim::calibration
