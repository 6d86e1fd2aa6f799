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

/// Of a run; more gain little and weigh the tracker's noise more.
constexpr int kPartsOfARun = 8;

/// The runs cut at `parts` nearly equal steps of their way and turning (one step where there are end points only).
/// Places of the cuts do not depend on parameters that are fitted: an answer that moved them would jump.
class CutRuns {
 public:
  /// Steps of ways by `nominal`. `runs` must outlive it.
  CutRuns(const Runs& runs, const OdometryParameters& nominal, int parts);

  /// All pieces, reckoned by `odometry`.
  std::vector<Piece> pieces(const OdometryParameters& odometry) const;

 private:
  const Runs& runs_;
  std::vector<std::vector<std::size_t>> rows_;  ///< of the truth, at which each run is cut
};

/// Condition number of a symmetric matrix of normal equations after scaling its diagonal to one; infinite where it is
/// singular.
double condition_number(const Eigen::MatrixXd& normal);

}  // namespace umbsim::calibration
