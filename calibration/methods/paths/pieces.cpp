#include "calibration/methods/paths/pieces.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

namespace umbsim::calibration {
namespace {

// Rows of the truth at which to cut.
std::vector<std::size_t> cuts(const TrainingRun& run, const std::vector<Travel>& at, int parts) {
  std::vector<double> done{0};  // way of the middle, and of the wheels about it
  for (std::size_t k = 1; k < at.size(); ++k) {
    const double left = at[k].left_m - at[k - 1].left_m, right = at[k].right_m - at[k - 1].right_m;
    done.push_back(done.back() + std::abs(left + right) / 2 + std::abs(right - left) / 2);
  }
  std::vector<std::size_t> rows{0};
  if (!run.tracked()) parts = 1;
  for (std::size_t k = 1; k + 1 < at.size(); ++k) {
    if (done[k] >= done.back() * double(rows.size()) / parts && int(rows.size()) < parts) rows.push_back(k);
  }
  rows.push_back(at.size() - 1);
  return rows;
}

}  // namespace

std::vector<Piece> pieces(const TrainingRun& run, const OdometryParameters& odometry, int parts) {
  const std::vector<TruthSample>& truth = run.run->truth;
  std::vector<double> times_s;
  for (const TruthSample& t : truth) times_s.push_back(t.time_s);
  // An end point is of the end, whenever it was written down.
  if (!run.tracked()) times_s = {run.run->encoders.front().time_s, run.run->encoders.back().time_s};
  const std::vector<Travel> at = travel(*run.run, odometry, times_s);
  const std::vector<std::size_t> rows = cuts(run, at, parts);
  std::vector<Piece> result;
  for (std::size_t k = 1; k < rows.size(); ++k) {
    const Pose2& from = run.tracked() ? truth[rows[k - 1]].X_WB : truth.front().X_WB;
    const Pose2& to = run.tracked() ? truth[rows[k]].X_WB : truth.back().X_WB;
    result.push_back({&run, inverse(from) * to, between(at[rows[k - 1]], at[rows[k]])});
  }
  return result;
}

std::vector<Piece> pieces(const Runs& runs, const OdometryParameters& odometry, int parts) {
  std::vector<Piece> all;
  for (const TrainingRun& run : runs) {
    for (Piece& p : pieces(run, odometry, parts)) all.push_back(std::move(p));
  }
  return all;
}

double condition_number(const Eigen::MatrixXd& normal) {
  const Eigen::VectorXd d = normal.diagonal().cwiseSqrt();
  if (!(d.minCoeff() > 0)) return std::numeric_limits<double>::infinity();
  const Eigen::MatrixXd scaled = d.cwiseInverse().asDiagonal() * normal * d.cwiseInverse().asDiagonal();
  const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled).eigenvalues();
  return values[0] > 1e-15 * values[values.size() - 1] ? values[values.size() - 1] / values[0]
                                                       : std::numeric_limits<double>::infinity();
}

}  // namespace umbsim::calibration
