#include "gap/noise/track_filter.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace umbsim::gap {
namespace {

// Standard deviations of the start pose before anything is seen: the tracker's frame and the start are free.
constexpr double kStart_m = 0.02;
constexpr double kStart_rad = 0.2;

// By how much headings differ about each sample: the mean over three samples on either side, of fewer at the ends.
std::vector<double> averaged_turns(const std::vector<Pose2>& predicted, const std::vector<Pose2>& actual) {
  const std::size_t n = std::min(predicted.size(), actual.size());
  std::vector<double> averaged(n);
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t reach = std::min({std::size_t(3), k, n - 1 - k});
    for (std::size_t i = k - reach; i <= k + reach; ++i)
      averaged[k] += (actual[i].theta_rad - predicted[i].theta_rad) / double(2 * reach + 1);
  }
  return averaged;
}

}  // namespace

double roughness_m_per_sqrt_m(double heading_walk_rad_per_sqrt_m, double wheelbase_m) {
  return heading_walk_rad_per_sqrt_m * wheelbase_m / std::sqrt(2.0);
}

Eigen::Matrix3d error_transition(const Pose2& u) {
  const double c = std::cos(u.theta_rad);
  const double s = std::sin(u.theta_rad);
  Eigen::Matrix3d T;
  T << c, s, -c * u.y_m + s * u.x_m,  //
      -s, c, s * u.y_m + c * u.x_m,   //
      0, 0, 1;
  return T;
}

Eigen::VectorXd track_error(const std::vector<Pose2>& predicted, const std::vector<Pose2>& actual) {
  const std::size_t n = std::min(predicted.size(), actual.size());
  Eigen::VectorXd error(3 * n);
  for (std::size_t k = 0; k < n; ++k) {
    const Pose2 e = inverse(predicted[k]) * actual[k];
    error.segment<3>(3 * Eigen::Index(k)) << e.x_m, e.y_m, e.theta_rad;
  }
  return error;
}

std::vector<Eigen::Vector3d> motion_errors(const std::vector<Pose2>& predicted, const std::vector<Pose2>& actual) {
  const std::size_t n = std::min(predicted.size(), actual.size());
  std::vector<Eigen::Vector3d> errors(n, Eigen::Vector3d::Zero());
  for (std::size_t k = 1; k < n; ++k) {
    const Pose2 foretold = inverse(predicted[k - 1]) * predicted[k];
    const Pose2 wrong = inverse(foretold) * (inverse(actual[k - 1]) * actual[k]);
    errors[k] = {wrong.x_m, wrong.y_m, wrong.theta_rad};
  }
  return errors;
}

TrackFilter::TrackFilter(const std::vector<Pose2>& path, const std::vector<double>& rolled_m, const NoiseModel& noise,
                         const std::vector<bool>& observed, const std::vector<Eigen::Vector3d>& velocity,
                         const std::vector<Eigen::Vector3d>& more) {
  const double p = noise.position_sd_m * noise.position_sd_m;
  const Eigen::Matrix3d R = Eigen::Vector3d(p, p, noise.heading_sd_rad * noise.heading_sd_rad).asDiagonal();
  Eigen::Matrix3d P = Eigen::Vector3d(kStart_m * kStart_m, kStart_m * kStart_m, kStart_rad * kStart_rad).asDiagonal();
  steps_.reserve(path.size());
  sees_headings_ = noise.sees_headings();
  for (std::size_t k = 0; k < path.size(); ++k) {
    Step step;
    step.transition.setIdentity();
    if (k > 0) {
      const Pose2 u = inverse(path[k - 1]) * path[k];
      step.transition = error_transition(u);
      P = (step.transition * P * step.transition.transpose()).eval();
      P.diagonal() += rolled_m[k] * Eigen::Vector3d(noise.along_m2_pm, noise.across_m2_pm, noise.heading_rad2_pm);
      if (!more.empty()) P.diagonal() += more[k];
    }
    if (!observed.empty() && !observed[k]) {
      step.gain.setZero();
      step.whitener.setZero();
      steps_.push_back(step);
      continue;
    }
    Eigen::Matrix3d S = P + R;
    if (!velocity.empty()) S += noise.clock_s * noise.clock_s * velocity[k] * velocity[k].transpose();
    const Eigen::LLT<Eigen::Matrix3d> llt(S);
    step.gain = llt.solve(P).transpose();
    step.whitener = llt.matrixL().solve(Eigen::Matrix3d::Identity());
    log_det_ -= 2 * step.whitener.diagonal().array().log().sum();
    P = ((Eigen::Matrix3d::Identity() - step.gain) * P).eval();
    P = (0.5 * (P + P.transpose())).eval();
    steps_.push_back(step);
  }
}

Eigen::VectorXd TrackFilter::error(const std::vector<Pose2>& predicted, const std::vector<Pose2>& actual) const {
  Eigen::VectorXd error = track_error(predicted, actual);
  if (!sees_headings_) return error;
  const std::vector<double> turned = averaged_turns(predicted, actual);
  for (std::size_t k = 1; k < turned.size(); ++k) {
    const Pose2 before{actual[k - 1].x_m, actual[k - 1].y_m, predicted[k - 1].theta_rad + turned[k - 1]};
    const Pose2 motion = inverse(before) * actual[k];
    const double misread_rad = error[3 * Eigen::Index(k) - 1] - turned[k - 1];
    const Pose2 foretold = inverse(predicted[k - 1]) * predicted[k];
    const Pose2 as_read{motion.x_m + misread_rad * foretold.y_m, motion.y_m - misread_rad * foretold.x_m, 0};
    const Pose2 wrong = inverse(foretold) * as_read;
    const double turn_rad = error[3 * Eigen::Index(k) + 2] - error[3 * Eigen::Index(k) - 1];
    error.segment<3>(3 * Eigen::Index(k)) = steps_[k].transition * error.segment<3>(3 * Eigen::Index(k) - 3) +
                                            Eigen::Vector3d(wrong.x_m, wrong.y_m, turn_rad);
  }
  return error;
}

TrackColumns TrackFilter::whiten(const TrackColumns& columns) const {
  TrackColumns white(columns.rows(), columns.cols());
  Eigen::Matrix<double, 3, Eigen::Dynamic> state(3, columns.cols());
  Eigen::Matrix<double, 3, Eigen::Dynamic> innovation(3, columns.cols());
  state.setZero();
  for (std::size_t k = 0; k < steps_.size(); ++k) {
    const Step& s = steps_[k];
    state = (s.transition * state).eval();
    innovation = columns.middleRows<3>(3 * Eigen::Index(k)) - state;
    white.middleRows<3>(3 * Eigen::Index(k)).noalias() = s.whitener * innovation;
    state.noalias() += s.gain * innovation;
  }
  return white;
}

TrackFilter::ImpulseProducts TrackFilter::impulse_products(const Eigen::VectorXd& white) const {
  ImpulseProducts p{std::vector<Eigen::Vector3d>(steps_.size()), std::vector<Eigen::Matrix3d>(steps_.size())};
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  Eigen::Matrix3d M = Eigen::Matrix3d::Zero();
  for (std::size_t k = steps_.size(); k-- > 0;) {
    const Step& s = steps_[k];
    Eigen::Matrix3d onward = Eigen::Matrix3d::Zero();
    if (k + 1 < steps_.size()) onward = steps_[k + 1].transition * (Eigen::Matrix3d::Identity() - s.gain);
    b = (s.whitener.transpose() * white.segment<3>(3 * Eigen::Index(k)) + onward.transpose() * b).eval();
    M = (s.whitener.transpose() * s.whitener + onward.transpose() * M * onward).eval();
    p.with_column[k] = b;
    p.with_itself[k] = M;
  }
  return p;
}

Eigen::VectorXd TrackFilter::propagate(const std::vector<Eigen::Vector3d>& impulses) const {
  Eigen::VectorXd track(3 * steps_.size());
  Eigen::Vector3d error = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < steps_.size(); ++k) {
    error = (steps_[k].transition * error + impulses[k]).eval();
    track.segment<3>(3 * Eigen::Index(k)) = error;
  }
  return track;
}

}  // namespace umbsim::gap
