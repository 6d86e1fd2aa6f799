#include "calibration/methods/likelihood.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "calibration/methods/jackknife.h"
#include "calibration/methods/likelihood_model.h"
#include "calibration/methods/scale.h"

namespace umbsim::calibration {
namespace {

constexpr int kRounds = 3;  // parameters and noise in turn

// Normal equations of every run in the common unknowns, its start eliminated.
struct Reduced {
  std::vector<Eigen::MatrixXd> normal;
  std::vector<Eigen::VectorXd> right;  ///< of a step of the unknowns
  Eigen::MatrixXd prior;
  Eigen::VectorXd prior_right;
};

Reduced reduced(const Model& m) {
  const Eigen::Index n = kRobotSize + kTrackerSize * Eigen::Index(m.trackers.size());
  Reduced result;
  for (std::size_t r = 0; r < m.runs.size(); ++r) {
    const TrackError::Linearised l = m.at(r);
    Eigen::MatrixXd columns(l.error.size(), 1 + l.by.cols());
    columns << l.error, l.by;
    m.whitening[r]->apply(columns);
    const Eigen::Index tracker = kRobotSize + kTrackerSize * Eigen::Index(m.block[r]);
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(columns.rows(), n);
    A.leftCols(kRobotSize) = columns.middleCols(1, kRobotSize);
    A.middleCols(tracker, kTrackerSize) = columns.middleCols(1 + kRobotSize, kTrackerSize);
    const Eigen::MatrixXd S = columns.rightCols(kStartSize);
    Eigen::MatrixXd SS = S.transpose() * S;
    Eigen::VectorXd Se = S.transpose() * columns.col(0);
    const auto prior = start_prior(m.runs[r]);
    for (int i = 0; i < kStartSize; ++i) {
      SS(i, i) += 1 / (prior[std::size_t(i)] * prior[std::size_t(i)]);
      Se[i] += m.starts[r][std::size_t(i)] / (prior[std::size_t(i)] * prior[std::size_t(i)]);
    }
    const Eigen::LDLT<Eigen::MatrixXd> solver(SS);
    const Eigen::MatrixXd AS = A.transpose() * S;
    result.normal.push_back(A.transpose() * A - AS * solver.solve(AS.transpose()));
    result.right.push_back(-(A.transpose() * columns.col(0) - AS * solver.solve(Se)));
  }
  result.prior = Eigen::MatrixXd::Zero(n, n);
  result.prior_right = Eigen::VectorXd::Zero(n);
  for (std::size_t t = 0; t < m.trackers.size(); ++t) {
    const auto sd = tracker_prior(m, t);
    for (int i = 0; i < kTrackerSize; ++i) {
      const Eigen::Index at = kRobotSize + kTrackerSize * Eigen::Index(t) + i;
      const double w = 1 / (sd[std::size_t(i)] * sd[std::size_t(i)]);
      result.prior(at, at) = w;
      result.prior_right[at] = -w * m.trackers[t][std::size_t(i)];
    }
  }
  return result;
}

void sum(const Reduced& all, std::size_t but, Eigen::MatrixXd& normal, Eigen::VectorXd& right) {
  normal = all.prior;
  right = all.prior_right;
  for (std::size_t r = 0; r < all.normal.size(); ++r) {
    if (r == but) continue;
    normal += all.normal[r];
    right += all.right[r];
  }
}

void intervals(Fit& fit, const Runs& runs, const Reduced& all) {
  constexpr std::size_t kNone = std::size_t(-1);
  Eigen::MatrixXd normal;
  Eigen::VectorXd right;
  sum(all, kNone, normal, right);
  const ScaleCheck whole = solve_with_scale(normal, right, fit.scale_observed);
  fit.condition = whole.condition;
  std::vector<std::optional<LogFactors>> left_out;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    sum(all, r, normal, right);
    left_out.push_back(fit.factors + solve_with_scale(normal, right, fit.scale_observed).step.head<3>());
  }
  const std::size_t said = fit.warnings.size();
  set_interval(fit, runs, left_out);
  if (fit.covariance) return;
  fit.warnings.resize(said);
  fit.warnings.push_back(
      "a condition was driven once only: the interval is the noise model's, not that of repeated runs");
  fit.covariance = whole.covariance.topLeftCorner<3, 3>();
  fit.degrees_of_freedom = 1e6;
}

}  // namespace

Fit fit_likelihood(const Runs& runs, const OdometryParameters& nominal) {
  if (runs.empty()) throw NotApplicable("there is no run");
  Model m = prepared(runs, nominal);
  Reduced all;
  for (int round = 0; round < kRounds; ++round) {
    set_whitening(m);
    if (round == 0) {
      all = reduced(m);
      Eigen::MatrixXd normal;
      Eigen::VectorXd right;
      sum(all, std::size_t(-1), normal, right);
      const ScaleCheck check = solve_with_scale(normal, right, true);
      if (!check.solved) throw NotApplicable(check.why);
      m.scale = check.observed;
    }
    solve(m);
    if (round + 1 < kRounds) fit_noise(m);
  }
  Fit fit;
  fit.factors = {m.robot[0], m.robot[1], m.robot[2]};
  if (fit.factors.norm() > 2) throw NotApplicable("the fit runs away: the paths do not tell the parameters");
  fit.scale_observed = m.scale;
  const double nan = std::nan("");
  const Estimate k{m.noise.wheel_m_per_sqrt_m, nan, nan};
  fit.noise = WheelNoise{k, k};
  for (std::size_t t = 0; t < m.trackers.size(); ++t) {
    if (!tracker_told(m, t)) continue;
    TrackerFit tracker{
        std::to_string(m.recordings[t]), m.trackers[t][0], m.trackers[t][1], m.trackers[t][2], 0, m.trackers[t][3]};
    double n = 0;
    for (std::size_t r = 0; r < m.runs.size(); ++r) {
      if (m.block[r] == t) tracker.clock_offset_s += m.starts[r][3], ++n;
    }
    tracker.clock_offset_s /= n;
    fit.trackers.push_back(tracker);
  }
  intervals(fit, runs, reduced(m));
  return fit;
}

}  // namespace umbsim::calibration
