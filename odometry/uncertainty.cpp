#include "odometry/uncertainty.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace umbsim {
namespace {

// Derivative of sin(x)/x, by its series where the difference would lose digits.
double sinc_slope(double x) {
  return std::abs(x) < 1e-2 ? x * (-1.0 / 3 + x * x * (1.0 / 30 - x * x / 840)) : (std::cos(x) - sinc(x)) / x;
}

}  // namespace

// The arc as its chord c = ds sinc(turn/2) along a = theta + turn/2, with ds = (left + right)/2 and
// turn = (right - left)/b.
ArcJacobians arc_jacobians(const Pose2& X_OB, double left_m, double right_m, double wheelbase_m) {
  const double ds_m = (left_m + right_m) / 2, turn_rad = (right_m - left_m) / wheelbase_m;
  const double along_rad = X_OB.theta_rad + turn_rad / 2;
  const Eigen::Vector3d forward(std::cos(along_rad), std::sin(along_rad), 0);
  const Eigen::Vector3d sideways(-forward.y(), forward.x(), 0);
  const double chord_m = ds_m * sinc(turn_rad / 2);

  ArcJacobians j;
  j.by_pose.setIdentity();
  j.by_pose.col(2) += chord_m * sideways;
  const Eigen::Vector3d by_ds = sinc(turn_rad / 2) * forward;
  const Eigen::Vector3d by_turn =
      ds_m / 2 * sinc_slope(turn_rad / 2) * forward + chord_m / 2 * sideways + Eigen::Vector3d::UnitZ();
  j.by_wheels.col(0) = by_ds / 2 - by_turn / wheelbase_m;
  j.by_wheels.col(1) = by_ds / 2 + by_turn / wheelbase_m;
  return j;
}

PoseCovariance after_arc(const PoseCovariance& covariance, const ArcJacobians& j, double left_m, double right_m,
                         const PathNoise& noise) {
  const double left = noise.left_m_per_sqrt_m, right = noise.right_m_per_sqrt_m;
  const Eigen::Vector2d variance(left * left * std::abs(left_m), right * right * std::abs(right_m));
  return j.by_pose * covariance * j.by_pose.transpose() +
         j.by_wheels * variance.asDiagonal() * j.by_wheels.transpose();
}

// H = 1: K = P (P + R)^-1. Joseph's form (1 - K) P (1 - K)' + K R K' keeps the covariance symmetric and positive.
UncertainPose absolute_fix(const UncertainPose& estimate, const Pose2& measured, const FixNoise& noise) {
  const double position = noise.position_sd_m, heading = noise.heading_sd_rad;
  const Eigen::Matrix3d R =
      Eigen::Vector3d(position * position, position * position, heading * heading).asDiagonal();
  const PoseCovariance& P = estimate.covariance;
  const Eigen::Matrix3d K = P * (P + R).inverse();
  const Pose2& X = estimate.X_OB;
  const Eigen::Vector3d innovation(measured.x_m - X.x_m, measured.y_m - X.y_m,
                                   wrap_angle(measured.theta_rad - X.theta_rad));
  const Eigen::Vector3d step = K * innovation;
  const Eigen::Matrix3d rest = Eigen::Matrix3d::Identity() - K;
  return {{X.x_m + step.x(), X.y_m + step.y(), X.theta_rad + step.z()},
          rest * P * rest.transpose() + K * R * K.transpose()};
}

Ellipse ellipse_95(const PoseCovariance& P) {
  const double middle = (P(0, 0) + P(1, 1)) / 2;
  const double root = std::hypot((P(0, 0) - P(1, 1)) / 2, P(0, 1));
  return {std::sqrt(kChiSquare95 * (middle + root)), std::sqrt(kChiSquare95 * std::max(0.0, middle - root)),
          std::atan2(2 * P(0, 1), P(0, 0) - P(1, 1)) / 2};
}

// e' P^-1 e <= chi^2, without dividing by a determinant that may vanish.
bool inside_95(const UncertainPose& estimate, const Pose2& truth) {
  const PoseCovariance& P = estimate.covariance;
  const double x = truth.x_m - estimate.X_OB.x_m, y = truth.y_m - estimate.X_OB.y_m;
  const double determinant = P(0, 0) * P(1, 1) - P(0, 1) * P(0, 1);
  return x * x * P(1, 1) - 2 * x * y * P(0, 1) + y * y * P(0, 0) <= kChiSquare95 * determinant;
}

UncertainReckoning::UncertainReckoning(const OdometryParameters& parameters, const PathNoise& noise)
    : parameters_(parameters), noise_(noise), reckoning_(parameters, {}) {}

void UncertainReckoning::update(std::int64_t left_ticks, std::int64_t right_ticks) {
  if (noise_.any()) {
    const auto [left_m, right_m] =
        over_floor(parameters_, {double(left_ticks - left_ticks_) * parameters_.left_metres_per_tick(),
                                 double(right_ticks - right_ticks_) * parameters_.right_metres_per_tick()});
    const ArcJacobians j = arc_jacobians(pose(), left_m, right_m, parameters_.wheelbase_m);
    covariance_ = after_arc(covariance_, j, left_m, right_m, noise_);
  }
  left_ticks_ = left_ticks;
  right_ticks_ = right_ticks;
  reckoning_.update(left_ticks, right_ticks);
}

void UncertainReckoning::fix(const Pose2& measured_X_OB, const FixNoise& noise) {
  const UncertainPose corrected = absolute_fix(estimate(), measured_X_OB, noise);
  reckoning_.correct(corrected.X_OB);
  covariance_ = corrected.covariance;
}

}  // namespace umbsim
