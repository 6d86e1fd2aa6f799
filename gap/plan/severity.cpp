#include "gap/plan/severity.h"

#include <cmath>

namespace umbsim::gap {
namespace {

constexpr std::size_t kMoments = 120;  // of a run, as in a trial

using State = Eigen::Matrix<double, 5, 5>;  // of x, y, heading, and both wheels' relative radius errors

// Covariance of the pose error in the floor's axes, carried along a part of a run.
class Spread {
 public:
  Spread(const NoiseModel& noise, double wheelbase_m, double radius_scatter)
      : noise_(noise), wheelbase_m_(wheelbase_m), radius_variance_(radius_scatter * radius_scatter) {}

  void begin(const Eigen::Vector3d& variances) {
    P_.setZero();
    P_.diagonal() << variances, radius_variance_, radius_variance_;
  }

  void step(const Pose2& from, const Pose2& to, double rolled_m) {
    const Pose2 u = inverse(from) * to;
    const double middle_rad = from.theta_rad + u.theta_rad / 2;
    const double left_m = u.x_m - wheelbase_m_ / 2 * u.theta_rad;
    const double right_m = u.x_m + wheelbase_m_ / 2 * u.theta_rad;
    State F = State::Identity();
    F(0, 2) = -(to.y_m - from.y_m);
    F(1, 2) = to.x_m - from.x_m;
    F.block<1, 2>(0, 3) << left_m / 2 * std::cos(middle_rad), right_m / 2 * std::cos(middle_rad);
    F.block<1, 2>(1, 3) << left_m / 2 * std::sin(middle_rad), right_m / 2 * std::sin(middle_rad);
    F.block<1, 2>(2, 3) << -left_m / wheelbase_m_, right_m / wheelbase_m_;
    P_ = (F * P_ * F.transpose()).eval();
    const double c = std::cos(middle_rad);
    const double s = std::sin(middle_rad);
    const double along = noise_.along_m2_pm * rolled_m;
    const double across = noise_.across_m2_pm * rolled_m;
    P_(0, 0) += along * c * c + across * s * s;
    P_(1, 1) += along * s * s + across * c * c;
    P_(2, 2) += noise_.heading_rad2_pm * rolled_m;
  }
  Eigen::Vector3d variances() const { return P_.diagonal().head<3>(); }

 private:
  NoiseModel noise_;
  double wheelbase_m_;
  double radius_variance_;
  State P_ = State::Zero();
};

Eigen::Vector3d measured(const NoiseModel& noise) {
  const double p = noise.position_sd_m * noise.position_sd_m;
  return {p, p, noise.heading_sd_rad * noise.heading_sd_rad};
}

Eigen::Vector3d difference(const Pose2& a, const Pose2& b) {
  return {a.x_m - b.x_m, a.y_m - b.y_m, a.theta_rad - b.theta_rad};
}

std::vector<std::size_t> moments_of(const Model& model, std::size_t run) {
  const std::size_t last = model.nominal().tracks[run].size() - 1;
  if (model.campaign().of(run).truth_kind == "endpoints") return {last};
  std::vector<std::size_t> moments;
  for (std::size_t k = 1; k <= kMoments; ++k) moments.push_back(last * k / kMoments);
  return moments;
}

}  // namespace

NoiseFloors::NoiseFloors(const Model& model, std::vector<std::size_t> runs, double radius_scatter)
    : model_(model), runs_(std::move(runs)) {
  Eigen::Vector3d whole = Eigen::Vector3d::Zero();
  Eigen::Vector3d steps = Eigen::Vector3d::Zero();
  double count = 0;
  for (const std::size_t r : runs_) {
    const NoiseModel& noise = model.noise(r);
    moments_.push_back(moments_of(model, r));
    const auto& path = model.nominal().tracks[r];
    // The start is measured, too.
    Spread from_start(noise, model.recording().robot.wheelbase_m, radius_scatter);
    from_start.begin(measured(noise));
    Spread since_last = from_start;
    std::size_t k = 0;
    for (const std::size_t moment : moments_.back()) {
      const double heading_before = k == 0 ? 0 : from_start.variances()[2];
      since_last.begin({0, 0, heading_before});
      for (; k < moment; ++k) {
        from_start.step(path[k], path[k + 1], model.nominal().rolled_m[r][k + 1]);
        since_last.step(path[k], path[k + 1], model.nominal().rolled_m[r][k + 1]);
      }
      whole += from_start.variances() + measured(noise);
      steps += since_last.variances() - Eigen::Vector3d(0, 0, heading_before) + 2 * measured(noise);
      count += 1;
    }
  }
  whole_sd_ = (whole / count).cwiseSqrt();
  steps_sd_ = (steps / count).cwiseSqrt();
}

SizeRows NoiseFloors::rows(const std::vector<std::vector<Pose2>>& tracks) const {
  std::size_t count = 0;
  for (const auto& m : moments_) count += m.size();
  SizeRows result{Eigen::MatrixXd(3 * Eigen::Index(count), 1), Eigen::MatrixXd(3 * Eigen::Index(count), 1)};
  const double share = 1 / std::sqrt(3.0 * double(count));
  Eigen::Index row = 0;
  for (std::size_t i = 0; i < runs_.size(); ++i) {
    const auto& nominal = model_.nominal().tracks[runs_[i]];
    const auto& track = tracks[runs_[i]];
    const Pose2 X_SW = inverse(nominal.front());
    const Pose2 X_SW_track = inverse(track.front());
    Eigen::Vector3d before = Eigen::Vector3d::Zero();
    for (const std::size_t k : moments_[i]) {
      const Eigen::Vector3d change = difference(X_SW_track * track[k], X_SW * nominal[k]);
      result.whole.block<3, 1>(row, 0) = share * change.cwiseQuotient(whole_sd_);
      result.steps.block<3, 1>(row, 0) = share * (change - before).cwiseQuotient(steps_sd_);
      before = change;
      row += 3;
    }
  }
  return result;
}

}  // namespace umbsim::gap
