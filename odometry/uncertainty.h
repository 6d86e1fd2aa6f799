#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "odometry/dead_reckoning.h"

namespace umbsim {

/// Random error of each wheel's path: after a distance s its variance is k^2 s (Chong & Kleeman, "Accurate odometry and
/// error modelling for a mobile robot", ICRA 1997; they found 0.0004 to 0.0006 m per sqrt(m)). Both zero: off.
struct PathNoise {
  double left_m_per_sqrt_m = 0;
  double right_m_per_sqrt_m = 0;
  bool any() const { return left_m_per_sqrt_m > 0 || right_m_per_sqrt_m > 0; }
};

/// How well an absolute pose is measured: independent errors of x, y and heading.
struct FixNoise {
  double position_sd_m = 0.01;
  double heading_sd_rad = 0.01;
};

/// Covariance of (x, y, theta) in the frame of the pose itself; m^2, m rad, rad^2.
using PoseCovariance = Eigen::Matrix3d;

struct UncertainPose {
  Pose2 X_OB;
  PoseCovariance covariance = PoseCovariance::Zero();
};

/// Derivatives of the pose after an arc (pose2.h) by the pose before it and by both wheels' paths.
struct ArcJacobians {
  Eigen::Matrix3d by_pose;
  Eigen::Matrix<double, 3, 2> by_wheels;  ///< columns: left, right
};
ArcJacobians arc_jacobians(const Pose2& X_OB, double left_m, double right_m, double wheelbase_m);

/// The covariance after an arc: old errors carried along, and the new ones of both wheels, F P F' + G Q G'.
PoseCovariance after_arc(const PoseCovariance& covariance, const ArcJacobians& jacobians, double left_m,
                         double right_m, const PathNoise& noise);

/// Kalman update with a measured pose. `noise` must be positive. The heading is taken to the nearest turn.
UncertainPose absolute_fix(const UncertainPose& estimate, const Pose2& measured_X_OB, const FixNoise& noise);

/// Quantile of chi-square with two degrees of freedom: -2 ln(1 - 0.95).
constexpr double kChiSquare95 = 5.991464547107979;

/// The ellipse that holds the position 95 times in a hundred.
struct Ellipse {
  double a_m = 0;  ///< semi-axes, a >= b
  double b_m = 0;
  double angle_rad = 0;  ///< of a, from x
};
Ellipse ellipse_95(const PoseCovariance& covariance);

/// Whether the true position lies in that ellipse about the estimate.
bool inside_95(const UncertainPose& estimate, const Pose2& true_X_OB);

/// Dead reckoning that knows how far to trust itself. Without noise and fixes it is DeadReckoning, bit for bit.
class UncertainReckoning {
 public:
  UncertainReckoning(const OdometryParameters& parameters, const PathNoise& noise);

  void update(std::int64_t left_ticks, std::int64_t right_ticks);
  void fix(const Pose2& measured_X_OB, const FixNoise& noise);

  const Pose2& pose() const { return reckoning_.pose(); }
  UncertainPose estimate() const { return {pose(), covariance_}; }

 private:
  OdometryParameters parameters_;
  PathNoise noise_;
  DeadReckoning reckoning_;
  PoseCovariance covariance_ = PoseCovariance::Zero();
  std::int64_t left_ticks_ = 0;
  std::int64_t right_ticks_ = 0;
};

}  // namespace umbsim
