#pragma once

#include <Eigen/Core>
#include <vector>

#include "calibration/methods/paths/travel.h"

namespace umbsim::calibration {

/// Standard deviations of what is random in a track.
struct TrackNoise {
  double wheel_m_per_sqrt_m = 5e-4;
  double position_m = 5e-4;
  double heading_rad = 1e-3;
};

/// One moment of a track in the frame of its start: the robot, the tracked marker, the wheels' noise since the last
/// moment (for k = 1).
struct TrackNode {
  Pose2 body;
  Pose2 marker;
  Eigen::Matrix3d walk;  ///< of (x, y, theta), since the node before
};

std::vector<TrackNode> track_nodes(const std::vector<Travel>& at, double marker_x_m, double marker_y_m);

/// The Kalman filter of a random walk of the pose, seen with white noise: a fixed linear map that whitens errors of a
/// track (three rows a node: x, y, theta of the marker).
class Whitening {
 public:
  Whitening(const std::vector<TrackNode>& nodes, const TrackNoise& noise);
  void apply(Eigen::MatrixXd& columns) const;
  double log_det() const { return log_det_; }  ///< of the innovations' covariances, summed

 private:
  struct Step {
    Eigen::Matrix3d forward, seen, gain, whitener;
  };
  std::vector<Step> steps_;
  double log_det_ = 0;
};

/// The noise that makes these errors likeliest, found by a compass search on the logarithms from `first`; `free_sd`:
/// whether the tracker's levels are searched for, too.
TrackNoise likeliest_noise(const std::vector<std::vector<TrackNode>>& nodes, const std::vector<Eigen::VectorXd>& errors,
                           TrackNoise first, bool free_sd);

}  // namespace umbsim::calibration
