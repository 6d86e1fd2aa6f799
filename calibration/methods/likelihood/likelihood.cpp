#include "calibration/methods/likelihood/likelihood.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "calibration/methods/jackknife.h"
#include "calibration/methods/likelihood/likelihood_model.h"
#include "calibration/methods/likelihood/scrub.h"
#include "calibration/methods/paths/scale.h"

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
  result.prior(3, 3) = 1 / (scrub_prior(m) * scrub_prior(m));
  result.prior_right[3] = -m.robot[3] * result.prior(3, 3);
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

// Over the runs with these weights.
void sum(const Reduced& all, const std::vector<double>& weights, Eigen::MatrixXd& normal, Eigen::VectorXd& right) {
  normal = all.prior;
  right = all.prior_right;
  for (std::size_t r = 0; r < all.normal.size(); ++r) {
    normal += weights[r] * all.normal[r];
    right += weights[r] * all.right[r];
  }
}

std::vector<double> weights_of(const Runs& runs) {
  std::vector<double> weights;
  for (const TrainingRun& r : runs) weights.push_back(r.weight);
  return weights;
}

// The run's own weight goes to those of its condition.
std::vector<double> weights_without(const Runs& runs, std::size_t left_out) {
  std::vector<double> weights = weights_of(without_run(runs, left_out));
  weights.insert(weights.begin() + std::ptrdiff_t(left_out), 0);
  return weights;
}

bool driven_again(const Runs& runs, std::size_t run) {
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (i != run && runs[i].condition == runs[run].condition) return true;
  }
  return false;
}

// Intervals of the fit; what they say of scrub, where it is fitted.
ScrubFit intervals(Fit& fit, const Runs& runs, const Reduced& all) {
  Eigen::MatrixXd normal;
  Eigen::VectorXd right;
  sum(all, weights_of(runs), normal, right);
  const ScaleCheck whole = solve_with_scale(normal, right, fit.scale_observed);
  fit.condition = whole.condition;
  const double variance = whole.covariance(3, 3);
  ScrubFit scrub{fit.scrub ? fit.scrub->value : 0, variance, whole.covariance.block<3, 1>(0, 3) / variance, {}};
  std::vector<std::optional<LogFactors>> left_out;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    if (!driven_again(runs, r)) {
      left_out.emplace_back();
      scrub.left_out.push_back(scrub.value);
      continue;
    }
    sum(all, weights_without(runs, r), normal, right);
    const Eigen::VectorXd step = solve_with_scale(normal, right, fit.scale_observed).step;
    left_out.push_back(fit.factors + step.head<3>());
    scrub.left_out.push_back(scrub.value + step[3]);
  }
  const std::size_t said = fit.warnings.size();
  set_interval(fit, runs, left_out);
  if (!fit.covariance.empty()) return scrub;
  fit.warnings.resize(said);
  fit.warnings.push_back(
      "a condition was driven once only: the interval is the noise model's, not that of repeated runs");
  fit.covariance = {{whole.covariance.topLeftCorner<3, 3>(), kManyDegrees}};
  return scrub;
}

Fit fit_model(const Runs& runs, const OdometryParameters& nominal, bool scrub) {
  if (runs.empty()) throw NotApplicable("there is no run");
  Model m = prepared(runs, nominal);
  m.scrub = scrub;
  Reduced all;
  for (int round = 0; round < kRounds; ++round) {
    set_whitening(m);
    if (round == 0) {
      all = reduced(m);
      Eigen::MatrixXd normal;
      Eigen::VectorXd right;
      sum(all, weights_of(runs), normal, right);
      const ScaleCheck check = solve_with_scale(normal, right, true);
      if (!check.solved) throw NotApplicable(check.why);
      m.scale = check.observed;
    }
    solve(m);
    if (round + 1 < kRounds) fit_noise(m);
  }
  Fit fit;
  fit.factors = {m.robot[0], m.robot[1], m.robot[2]};
  if (scrub) fit.scrub = Estimate{m.robot[3], m.robot[3], m.robot[3]};
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
  const ScrubFit said = intervals(fit, runs, reduced(m));
  if (scrub) believe(said, runs, fit);
  return fit;
}

}  // namespace

Fit fit_likelihood(const Runs& runs, const OdometryParameters& nominal) { return fit_model(runs, nominal, false); }

Fit fit_scrub(const Runs& runs, const OdometryParameters& nominal) {
  const bool tracked = std::any_of(runs.begin(), runs.end(), [](const TrainingRun& r) { return r.tracked(); });
  if (!tracked) throw NotApplicable("needs tracks: end points do not tell scrub from the wheelbase");
  return fit_model(runs, nominal, true);
}

}  // namespace umbsim::calibration
