#include "calibration/methods/likelihood.h"

#include <ceres/ceres.h>
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <array>
#include <cmath>
#include <map>
#include <memory>

#include "calibration/methods/jackknife.h"
#include "calibration/methods/scale.h"
#include "calibration/methods/track_error.h"
#include "calibration/methods/whitening.h"

namespace umbsim::calibration {
namespace {

constexpr std::size_t kNodes = 150;  // of a track
constexpr int kRounds = 3;           // parameters and noise in turn
// Of a tracker: rad, m, m, and a clock's rate, which on a steady circle no data tell from the mean radius.
constexpr std::array<double, kTrackerSize> kTrackerPrior{0.3, 0.3, 0.3, 0.002};
constexpr double kClockPrior_s = 0.3;
constexpr double kNotFitted = 1e-9;  // prior of what end points cannot tell

using Common = Eigen::VectorXd;  // robot, then one block for each recording's tracker

struct Model {
  std::vector<TrackError> runs;
  std::vector<std::size_t> block;  ///< of each run: which tracker
  std::vector<std::size_t> recordings;
  std::array<double, kRobotSize> robot{};
  std::vector<std::array<double, kTrackerSize>> trackers;
  std::vector<std::array<double, kStartSize>> starts;
  TrackNoise noise;
  std::vector<std::unique_ptr<Whitening>> whitening;
  bool scale = true;

  TrackError::Linearised at(std::size_t r) const {
    return runs[r].at(robot.data(), trackers[block[r]].data(), starts[r].data());
  }
};

// Residuals of one run for Ceres.
class RunCost : public ceres::CostFunction {
 public:
  RunCost(const TrackError& run, const Whitening& whitening) : run_(run), whitening_(whitening) {
    set_num_residuals(int(3 * run.nodes().size()));
    *mutable_parameter_block_sizes() = {kRobotSize, kTrackerSize, kStartSize};
  }
  bool Evaluate(double const* const* p, double* residuals, double** jacobians) const override {
    const TrackError::Linearised l = run_.at(p[0], p[1], p[2]);
    Eigen::MatrixXd columns(l.error.size(), jacobians ? 1 + l.by.cols() : 1);
    columns.col(0) = l.error;
    if (jacobians) columns.rightCols(l.by.cols()) = l.by;
    whitening_.apply(columns);
    Eigen::VectorXd::Map(residuals, columns.rows()) = columns.col(0);
    int first = 1;
    for (int b = 0; jacobians && b < 3; ++b) {
      const int size = parameter_block_sizes()[std::size_t(b)];
      using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
      if (jacobians[b]) Eigen::Map<Rows>(jacobians[b], columns.rows(), size) = columns.middleCols(first, size);
      first += size;
    }
    return columns.allFinite();
  }

 private:
  const TrackError& run_;
  const Whitening& whitening_;
};

// Value over standard deviation, of one block about zero.
template <int size>
class Prior : public ceres::SizedCostFunction<size, size> {
 public:
  explicit Prior(std::array<double, size> sd) : sd_(sd) {}
  bool Evaluate(double const* const* p, double* residuals, double** jacobians) const override {
    for (int i = 0; i < size; ++i) residuals[i] = p[0][i] / sd_[std::size_t(i)];
    if (!jacobians || !jacobians[0]) return true;
    std::fill(jacobians[0], jacobians[0] + size * size, 0.0);
    for (int i = 0; i < size; ++i) jacobians[0][i * size + i] = 1 / sd_[std::size_t(i)];
    return true;
  }

 private:
  std::array<double, size> sd_;
};

// Keeps the mean radius: log left + log right = 0, as sharply as it matters.
class ScalePrior : public ceres::SizedCostFunction<1, kRobotSize> {
 public:
  bool Evaluate(double const* const* p, double* residuals, double** jacobians) const override {
    residuals[0] = (p[0][0] + p[0][1]) / 2 / kSd;
    if (jacobians && jacobians[0]) {
      jacobians[0][0] = jacobians[0][1] = 0.5 / kSd;
      jacobians[0][2] = 0;
    }
    return true;
  }
  static constexpr double kSd = 1e-7;
};

bool tracker_told(const Model& m, std::size_t tracker) {
  for (std::size_t r = 0; r < m.runs.size(); ++r) {
    if (m.block[r] == tracker && m.runs[r].tracked()) return true;
  }
  return false;
}

std::array<double, kTrackerSize> tracker_prior(const Model& m, std::size_t tracker) {
  if (tracker_told(m, tracker)) return kTrackerPrior;
  return {kNotFitted, kNotFitted, kNotFitted, kNotFitted};
}

std::array<double, kStartSize> start_prior(const TrackError& run) {
  return {1e6, 1e6, 1e6, run.tracked() ? kClockPrior_s : kNotFitted};
}

void solve(Model& m) {
  ceres::Problem::Options owning;
  ceres::Problem problem(owning);
  for (std::size_t r = 0; r < m.runs.size(); ++r) {
    problem.AddResidualBlock(new RunCost(m.runs[r], *m.whitening[r]), nullptr, m.robot.data(),
                             m.trackers[m.block[r]].data(), m.starts[r].data());
    problem.AddResidualBlock(new Prior<kStartSize>(start_prior(m.runs[r])), nullptr, m.starts[r].data());
  }
  for (std::size_t t = 0; t < m.trackers.size(); ++t)
    problem.AddResidualBlock(new Prior<kTrackerSize>(tracker_prior(m, t)), nullptr, m.trackers[t].data());
  if (!m.scale) problem.AddResidualBlock(new ScalePrior, nullptr, m.robot.data());
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_SCHUR;
  options.max_num_iterations = 50;
  options.function_tolerance = 1e-10;
  options.parameter_tolerance = 1e-9;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable()) throw NotApplicable("the fit does not come to rest: " + summary.message);
}

void set_whitening(Model& m) {
  m.whitening.clear();
  for (std::size_t r = 0; r < m.runs.size(); ++r) {
    const auto& t = m.trackers[m.block[r]];
    m.whitening.push_back(std::make_unique<Whitening>(track_nodes(m.at(r).at, t[1], t[2]), m.noise));
  }
}

void fit_noise(Model& m) {
  std::vector<std::vector<TrackNode>> nodes;
  std::vector<Eigen::VectorXd> errors;
  bool tracked = false;
  for (std::size_t r = 0; r < m.runs.size(); ++r) {
    TrackError::Linearised l = m.at(r);
    const auto& t = m.trackers[m.block[r]];
    nodes.push_back(track_nodes(l.at, t[1], t[2]));
    errors.push_back(std::move(l.error));
    tracked = tracked || m.runs[r].tracked();
  }
  m.noise = likeliest_noise(nodes, errors, m.noise, tracked);
}

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

Model prepared(const Runs& runs, const OdometryParameters& nominal) {
  Model m;
  std::map<std::size_t, std::size_t> blocks;
  for (const TrainingRun& r : runs) {
    const auto [block, is_new] = blocks.emplace(r.recording_index, blocks.size());
    if (is_new) m.recordings.push_back(r.recording_index);
    m.block.push_back(block->second);
    m.runs.emplace_back(r, nominal, kNodes);
    const Pose2& first = m.runs.back().nodes().front().X_WB;
    m.starts.push_back({first.x_m, first.y_m, first.theta_rad, 0});
    m.noise.position_m = std::max(r.recording->truth_position_sd_m, 1e-4);
    m.noise.heading_rad = std::max(r.recording->truth_heading_sd_rad, 1e-4);
  }
  m.trackers.resize(m.recordings.size());
  return m;
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
