// Whitened residuals, their derivatives, and what a descent takes along of these.
#include <tbb/parallel_for.h>

#include <algorithm>

#include "gap/evidence/model.h"

namespace umbsim::gap {
namespace {

constexpr double kBendShare = 0.01;  // of a step, squared, by which it may end elsewhere than its derivatives foretold,
constexpr double kBend = 1;          // or as much in squared standard deviations of the tracks

bool same(const std::vector<Pose2>& a, const std::vector<Pose2>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Pose2& at, const Pose2& there) {
    return at.x_m == there.x_m && at.y_m == there.y_m && at.theta_rad == there.theta_rad;
  });
}

}  // namespace

// What happens at a place or in one run leaves most runs as they are.
void Model::look_without_effects() {
  products_of_nuisances_ = products_of_nuisances();
  unmoved_ = {};
  const std::vector<Eigen::VectorXd> residual = residuals(without_effects_);
  unmoved_ = {residual, grams(residual, {})};
}

std::vector<Eigen::VectorXd> Model::residuals(const Predicted& predicted) const {
  std::vector<Eigen::VectorXd> result(recording().runs.size());
  tbb::parallel_for(std::size_t(0), result.size(), [&](std::size_t r) {
    if (predicted.tracks[r].empty()) return;
    const bool unmoved = !unmoved_.residuals.empty() && same(predicted.tracks[r], without_effects_.tracks[r]);
    const Eigen::Index n = 3 * Eigen::Index(filters_[r].samples());
    result[r].resize(n + kFeatureRows);
    result[r].tail(kFeatureRows) = feature_rows(r, measured_, predicted);
    if (unmoved)
      result[r].head(n) = unmoved_.residuals[r].head(n);
    else
      result[r].head(n) = filters_[r].whiten(filters_[r].error(predicted.tracks[r], nominal_.truth[r]));
  });
  return result;
}

std::vector<Eigen::MatrixXd> Model::columns(const Predicted& at, const std::vector<Predicted>& stepped,
                                            const std::vector<double>& steps) const {
  std::vector<Eigen::MatrixXd> result(recording().runs.size());
  tbb::parallel_for(std::size_t(0), result.size(), [&](std::size_t r) {
    const Eigen::Index n = 3 * Eigen::Index(filters_[r].samples());
    Eigen::MatrixXd raw(n, Eigen::Index(stepped.size()));
    result[r].resize(n + kFeatureRows, raw.cols());
    for (std::size_t j = 0; j < stepped.size(); ++j) {
      raw.col(Eigen::Index(j)) = filters_[r].error(at.tracks[r], stepped[j].tracks[r]) / steps[j];
      result[r].col(Eigen::Index(j)).tail(kFeatureRows) = feature_rows(r, stepped[j], at) / steps[j];
    }
    result[r].topRows(n) = filters_[r].whiten(raw);
  });
  return result;
}

// A step that ended elsewhere than foretold says how the derivatives along it really were (Broyden 1965). `scale`: of
// the numbers.
void Linearisation::learn(const Eigen::VectorXd& to, const std::vector<Eigen::VectorXd>& there,
                          const Eigen::VectorXd& scale) {
  const Eigen::VectorXd step = to - p;
  const Eigen::VectorXd direction = step.cwiseQuotient(scale.cwiseAbs2());
  const double length2 = step.dot(direction);
  for (std::size_t r = 0; r < columns.size(); ++r) {
    const Eigen::VectorXd missed = residual[r] - there[r] - columns[r] * step;
    columns[r] += missed * (direction / length2).transpose();
  }
  p = to;
  residual = there;
}

bool Linearisation::foretold(const Eigen::VectorXd& to, const std::vector<Eigen::VectorXd>& there) const {
  double moved = 0;
  double missed = 0;
  for (std::size_t r = 0; r < columns.size(); ++r) {
    const Eigen::VectorXd by = columns[r] * (to - p);
    moved += by.squaredNorm();
    missed += (residual[r] - by - there[r]).squaredNorm();
  }
  return missed <= kBend + kBendShare * moved;
}

}  // namespace umbsim::gap
