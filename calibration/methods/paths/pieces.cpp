#include "calibration/methods/paths/pieces.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace umbsim::calibration {
namespace {

// An end point is of the end, whenever it was written down.
std::vector<double> times_of(const TrainingRun& run, const std::vector<std::size_t>& rows) {
  if (!run.tracked()) return {run.run->encoders.front().time_s, run.run->encoders.back().time_s};
  std::vector<double> times_s;
  for (const std::size_t row : rows) times_s.push_back(run.run->truth[row].time_s);
  return times_s;
}

std::vector<std::size_t> cuts(const TrainingRun& run, const OdometryParameters& nominal, int parts) {
  std::vector<std::size_t> every(run.run->truth.size());
  std::iota(every.begin(), every.end(), 0);
  if (!run.tracked()) return {every.front(), every.back()};
  const std::vector<Travel> at = travel(*run.run, nominal, times_of(run, every));
  std::vector<double> done{0};  // way of the middle, and of the wheels about it
  for (std::size_t k = 1; k < at.size(); ++k) {
    const double left = at[k].left_m - at[k - 1].left_m, right = at[k].right_m - at[k - 1].right_m;
    done.push_back(done.back() + std::abs(left + right) / 2 + std::abs(right - left) / 2);
  }
  std::vector<std::size_t> rows{0};
  for (int part = 1; part < parts; ++part) {
    // The nearest row: the first one beyond would be another one for a rounding where parts end with legs.
    const double wanted = done.back() * part / parts;
    auto row = std::lower_bound(done.begin(), done.end(), wanted);
    if (row != done.begin() && wanted - *(row - 1) < *row - wanted) --row;
    const std::size_t k = std::size_t(row - done.begin());
    if (k > rows.back() && k + 1 < at.size()) rows.push_back(k);
  }
  rows.push_back(at.size() - 1);
  return rows;
}

}  // namespace

CutRuns::CutRuns(const Runs& runs, const OdometryParameters& nominal, int parts) : runs_(runs) {
  for (const TrainingRun& run : runs) rows_.push_back(cuts(run, nominal, parts));
}

std::vector<Piece> CutRuns::pieces(const OdometryParameters& odometry) const {
  std::vector<Piece> all;
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    const std::vector<TruthSample>& truth = runs_[r].run->truth;
    const std::vector<Travel> at = travel(*runs_[r].run, odometry, times_of(runs_[r], rows_[r]));
    for (std::size_t k = 1; k < at.size(); ++k) {
      const Pose2 &from = truth[rows_[r][k - 1]].X_WB, &to = truth[rows_[r][k]].X_WB;
      all.push_back({&runs_[r], inverse(from) * to, between(at[k - 1], at[k])});
    }
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
