#include "calibration/methods/paths/kelly.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>

#include "calibration/methods/paths/pieces.h"
#include "calibration/methods/paths/scale.h"

namespace umbsim::calibration {
namespace {

constexpr int kRounds = 40;
constexpr double kStepDone = 1e-8;
constexpr double kNoiseDone = 1e-5;        // of the variances
constexpr double kFirst_m = 0.0005;        // k to begin with, m per sqrt(m)
constexpr double kLeastPosition_m = 1e-4;  // of the tracker, where the recording says less
constexpr double kLeastHeading_rad = 1e-4;

Eigen::Matrix3d tracker_noise(const Recording& r) {
  // Both ends are measured.
  const double p = std::max(r.truth_position_sd_m, kLeastPosition_m);
  const double h = std::max(r.truth_heading_sd_rad, kLeastHeading_rad);
  return 2 * Eigen::Vector3d(p * p, p * p, h * h).asDiagonal().toDenseMatrix();
}

struct State {
  LogFactors factors = LogFactors::Zero();
  std::map<std::size_t, double> turned_rad;                             ///< of each recording's tracker
  Eigen::Vector2d k2 = Eigen::Vector2d::Constant(kFirst_m * kFirst_m);  ///< of the left wheel and the right one
};

// Error of one piece: residual, its derivatives by factors and by the tracker's turn, its covariance.
struct Row {
  Eigen::Vector3d error;
  Eigen::Matrix<double, 3, 4> by;
  Eigen::Matrix3d left, right, tracker;
  std::size_t recording;
  double weight;
};

Row row_of(const Piece& p, const State& state) {
  const auto found = state.turned_rad.find(p.run->recording_index);
  const double turned = found == state.turned_rad.end() ? 0 : found->second;
  const double c = std::cos(turned), s = std::sin(turned);
  const double x = c * p.tracked.x_m - s * p.tracked.y_m, y = s * p.tracked.x_m + c * p.tracked.y_m;
  Row row;
  row.error << x - p.counted.pose.x_m, y - p.counted.pose.y_m, p.tracked.theta_rad - p.counted.pose.theta_rad;
  row.by.leftCols<3>() = p.counted.by_factor;
  row.by.col(3) = found == state.turned_rad.end() ? Eigen::Vector3d::Zero() : Eigen::Vector3d(y, -x, 0);
  row.left = p.counted.left_noise;
  row.right = p.counted.right_noise;
  // Heading noise at the start swings the whole piece.
  Eigen::Matrix3d swing = Eigen::Matrix3d::Identity();
  swing(0, 2) = -y, swing(1, 2) = x;
  const Eigen::Matrix3d one = tracker_noise(*p.run->recording) / 2;
  row.tracker = one + swing * one * swing.transpose();
  row.recording = p.run->recording_index;
  row.weight = p.run->weight;
  return row;
}

Eigen::Matrix3d weight(const Row& row, const State& s) {
  return (s.k2[0] * row.left + s.k2[1] * row.right + row.tracker).inverse();
}

struct ScoredNoise {
  Eigen::Vector2d k2;
  Eigen::Matrix2d information;
};

// Fisher scoring of both variances: least squares of the errors' outer products, weighted by their own covariance.
ScoredNoise score_noise(const std::vector<Row>& rows, double fitted, const State& s) {
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  Eigen::Vector2d target = Eigen::Vector2d::Zero();
  double n = 0;
  for (const Row& row : rows) n += 3 * row.weight;
  const double lost = n > fitted ? n / (n - fitted) : 1;  // to the parameters
  for (const Row& row : rows) {
    const Eigen::Matrix3d W = weight(row, s), L = W * row.left * W, R = W * row.right * W;
    const double half = row.weight / 2;
    information(0, 0) += half * (L * row.left).trace();
    information(1, 1) += half * (R * row.right).trace();
    information(0, 1) += half * (L * row.right).trace();
    target[0] += half * (lost * row.error.dot(L * row.error) - (L * row.tracker).trace());
    target[1] += half * (lost * row.error.dot(R * row.error) - (R * row.tracker).trace());
  }
  information(1, 0) = information(0, 1);
  Eigen::Vector2d k2 = information.ldlt().solve(target);
  // No variance is negative: the other one then explains all.
  if (k2[0] < 0) k2 = {0, std::max(0.0, target[1] / information(1, 1))};
  if (k2[1] < 0) k2 = {std::max(0.0, target[0] / information(0, 0)), 0};
  constexpr double kLeast = 1e-16;
  return {k2.cwiseMax(kLeast), information};
}

// k with an interval on the scale of k^2, which cannot be negative.
Estimate noise_estimate(double k2, double sd) {
  const double half = 1.959964 * sd;
  return {std::sqrt(k2), std::sqrt(std::max(0.0, k2 - half)), std::sqrt(k2 + half)};
}

struct Normal {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd right;
};

Normal normal_equations(const std::vector<Row>& rows, const State& s) {
  std::map<std::size_t, Eigen::Index> column;
  for (const auto& [recording, turned] : s.turned_rad) column.emplace(recording, 3 + Eigen::Index(column.size()));
  const Eigen::Index n = 3 + Eigen::Index(column.size());
  Normal normal{Eigen::MatrixXd::Zero(n, n), Eigen::VectorXd::Zero(n)};
  for (const Row& row : rows) {
    Eigen::MatrixXd by = Eigen::MatrixXd::Zero(3, n);
    by.leftCols<3>() = row.by.leftCols<3>();
    if (column.count(row.recording)) by.col(column[row.recording]) = row.by.col(3);
    const Eigen::Matrix3d W = row.weight * weight(row, s);
    normal.matrix += by.transpose() * W * by;
    normal.right += by.transpose() * (W * row.error);
  }
  return normal;
}

}  // namespace

Fit fit_kelly(const Runs& runs, const OdometryParameters& nominal) {
  State state;
  for (const TrainingRun& r : runs) {
    if (r.tracked()) state.turned_rad[r.recording_index] = 0;
  }
  Fit fit;
  Eigen::Matrix2d information = Eigen::Matrix2d::Identity();
  fit.scale_observed = true;
  const CutRuns cut(runs, nominal, kPartsOfARun);
  bool noise_rests = false, at_rest = false;
  for (int round = 0; round < kRounds && !at_rest; ++round) {
    std::vector<Row> rows;
    for (const Piece& p : cut.pieces(scaled(nominal, state.factors))) rows.push_back(row_of(p, state));
    if (round > 0) {
      const ScoredNoise scored = score_noise(rows, double(3 + state.turned_rad.size()), state);
      // Weights follow the variances, and these the weights, too far each time: half the step goes where they meet.
      const Eigen::Vector2d before = state.k2;
      state.k2 = round == 1 ? scored.k2 : Eigen::Vector2d((before + scored.k2) / 2);
      noise_rests = (state.k2 - before).norm() < kNoiseDone * state.k2.norm();
      information = scored.information;
    }
    const Normal normal = normal_equations(rows, state);
    const ScaleCheck scale = solve_with_scale(normal.matrix, normal.right, fit.scale_observed);
    if (!scale.solved) throw NotApplicable(scale.why);
    fit.scale_observed = scale.observed;
    fit.condition = scale.condition;
    state.factors += scale.step.head<3>();
    Eigen::Index column = 3;
    for (auto& [recording, turned] : state.turned_rad) turned += scale.step[column++];
    if (!state.factors.allFinite() || state.factors.norm() > 2)
      throw NotApplicable("the fit runs away: the paths do not tell the parameters");
    at_rest = noise_rests && scale.step.norm() < kStepDone;
  }
  if (!at_rest) fit.warnings.push_back(fmt::format("parameters and noise did not come to rest in {} rounds", kRounds));
  fit.factors = state.factors;
  const Eigen::Matrix2d covariance = information.inverse();
  fit.noise = WheelNoise{noise_estimate(state.k2[0], std::sqrt(std::abs(covariance(0, 0)))),
                         noise_estimate(state.k2[1], std::sqrt(std::abs(covariance(1, 1))))};
  for (const auto& [recording, turned] : state.turned_rad)
    fit.trackers.push_back({std::to_string(recording), turned, 0, 0, 0, 0});
  return fit;
}

}  // namespace umbsim::calibration
