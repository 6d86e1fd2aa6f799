#include "calibration/methods/likelihood/whitening.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

namespace umbsim::calibration {
namespace {

constexpr double kFirstStep = 0.7;  // of the logarithms
constexpr double kLastStep = 0.05;
constexpr std::array kLeast{1e-6, 1e-5, 1e-5};
constexpr std::array kMost{0.05, 0.2, 0.5};

double minus_log_likelihood(const std::vector<std::vector<TrackNode>>& nodes,
                            const std::vector<Eigen::VectorXd>& errors, const TrackNoise& noise) {
  double sum = 0;
  for (std::size_t r = 0; r < nodes.size(); ++r) {
    const Whitening whitening(nodes[r], noise);
    Eigen::MatrixXd column = errors[r];
    whitening.apply(column);
    sum += column.squaredNorm() + whitening.log_det();
  }
  return sum / 2;
}

}  // namespace

std::vector<TrackNode> track_nodes(const std::vector<Travel>& at, double marker_x_m, double marker_y_m) {
  std::vector<TrackNode> nodes;
  for (std::size_t k = 0; k < at.size(); ++k) {
    TrackNode node{at[k].pose, at[k].pose * Pose2{marker_x_m, marker_y_m, 0}, at[k].left_noise + at[k].right_noise};
    if (k > 0) {
      const Eigen::Matrix3d F = transition(at[k - 1].pose, at[k].pose);
      node.walk -= F * (at[k - 1].left_noise + at[k - 1].right_noise) * F.transpose();
    }
    nodes.push_back(node);
  }
  return nodes;
}

Whitening::Whitening(const std::vector<TrackNode>& nodes, const TrackNoise& noise) {
  const double k2 = noise.wheel_m_per_sqrt_m * noise.wheel_m_per_sqrt_m;
  const Eigen::Matrix3d R = Eigen::Vector3d(noise.position_m * noise.position_m, noise.position_m * noise.position_m,
                                            noise.heading_rad * noise.heading_rad)
                                .asDiagonal();
  Eigen::Matrix3d P = Eigen::Matrix3d::Zero();
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    Step step;
    step.forward = k > 0 ? transition(nodes[k - 1].body, nodes[k].body) : Eigen::Matrix3d::Identity();
    step.seen = transition(nodes[k].body, nodes[k].marker);
    P = step.forward * P * step.forward.transpose() + k2 * nodes[k].walk;
    const Eigen::Matrix3d S = step.seen * P * step.seen.transpose() + R;
    const Eigen::LLT<Eigen::Matrix3d> root(S);
    step.gain = root.solve(step.seen * P).transpose();
    step.whitener = root.matrixL().solve(Eigen::Matrix3d::Identity());
    P -= step.gain * step.seen * P;
    P = (P + P.transpose().eval()) / 2;
    log_det_ -= 2 * step.whitener.diagonal().array().log().sum();
    steps_.push_back(step);
  }
}

void Whitening::apply(Eigen::MatrixXd& columns) const {
  using Rows = Eigen::Matrix<double, 3, Eigen::Dynamic>;
  Rows e = Rows::Zero(3, columns.cols());
  Rows innovation(3, columns.cols());
  for (std::size_t k = 0; k < steps_.size(); ++k) {
    const Step& s = steps_[k];
    auto z = columns.middleRows<3>(3 * Eigen::Index(k));
    e = (s.forward * e).eval();
    innovation = z - s.seen * e;
    e += s.gain * innovation;
    z = s.whitener * innovation;
  }
}

TrackNoise likeliest_noise(const std::vector<std::vector<TrackNode>>& nodes, const std::vector<Eigen::VectorXd>& errors,
                           TrackNoise noise, bool free_sd) {
  const std::array<double TrackNoise::*, 3> levels{&TrackNoise::wheel_m_per_sqrt_m, &TrackNoise::position_m,
                                                   &TrackNoise::heading_rad};
  double best = minus_log_likelihood(nodes, errors, noise);
  for (double step = kFirstStep; step > kLastStep;) {
    bool better = false;
    for (std::size_t i = 0; i < (free_sd ? 3u : 1u); ++i) {
      for (const double sign : {-1.0, 1.0}) {
        TrackNoise tried = noise;
        tried.*levels[i] = std::clamp(noise.*levels[i] * std::exp(sign * step), kLeast[i], kMost[i]);
        if (tried.*levels[i] == noise.*levels[i]) continue;
        const double value = minus_log_likelihood(nodes, errors, tried);
        if (value >= best - 1e-9) continue;
        best = value;
        noise = tried;
        better = true;
        break;
      }
    }
    if (!better) step /= 2;
  }
  return noise;
}

}  // namespace umbsim::calibration
