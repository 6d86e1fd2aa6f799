#pragma once

#include <Eigen/Core>
#include <vector>

#include "odometry/dead_reckoning.h"
#include "recording/recording.h"

namespace umbsim::calibration {

/// Dead reckoning up to a moment, with how the pose answers to the parameters and to the wheels' random errors: the
/// path integrals of Kelly (2004), "Linearized error propagation in odometry", eqs. 25 and 30, summed exactly over the
/// arcs between two readings.
struct Travel {
  Pose2 pose;
  /// d(x, y, theta) by (log left radius, log right radius, log wheelbase).
  Eigen::Matrix3d by_factor = Eigen::Matrix3d::Zero();
  Eigen::Vector3d by_scrub = Eigen::Vector3d::Zero();  ///< the same by `OdometryParameters::scrub`
  /// Covariance of (x, y, theta) for k = 1 m per sqrt(m) of the left wheel, and of the right one.
  Eigen::Matrix3d left_noise = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d right_noise = Eigen::Matrix3d::Zero();
  double left_m = 0;  ///< rolled by the left wheel, signed
  double right_m = 0;
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< d(x, y, theta) by time, in the frame of the start
};

/// From the first encoder sample (the identity) to each of `times_s`, which must not decrease. Moments outside the
/// encoders' time count as the nearest end.
std::vector<Travel> travel(const RecordedRun& run, const OdometryParameters& odometry,
                           const std::vector<double>& times_s);

/// From one moment to a later one, in the frame of the first.
Travel between(const Travel& from, const Travel& to);

/// How an error (x, y, theta) of the pose at `from` carries on to `to`, both in one frame.
Eigen::Matrix3d transition(const Pose2& from, const Pose2& to);

}  // namespace umbsim::calibration
