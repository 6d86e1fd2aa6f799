#include "calibration/methods/likelihood/likelihood_model.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <map>

#include "calibration/methods/likelihood/scrub.h"

namespace umbsim::calibration {
namespace {

constexpr std::size_t kNodes = 150;  // of a track
// Of a tracker: rad, m, m, and a clock's rate, which on a steady circle no data tell from the mean radius.
constexpr std::array<double, kTrackerSize> kTrackerPrior{0.3, 0.3, 0.3, 0.002};
constexpr double kClockPrior_s = 0.3;
constexpr double kNotFitted = 1e-9;  // prior of what is not fitted, and of what end points cannot tell

// Residuals of one run for Ceres, which asks for a point's derivatives after it has seen its residuals: both are kept.
class RunCost : public ceres::CostFunction {
 public:
  RunCost(const TrackError& run, const Whitening& whitening) : run_(run), whitening_(whitening) {
    set_num_residuals(int(3 * run.nodes().size()));
    *mutable_parameter_block_sizes() = {kRobotSize, kTrackerSize, kStartSize};
  }
  bool Evaluate(double const* const* p, double* residuals, double** jacobians) const override {
    const Eigen::MatrixXd& columns = whitened(p);
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
  using Point = Eigen::Matrix<double, kRobotSize + kTrackerSize + kStartSize, 1>;

  // Error and its derivatives.
  const Eigen::MatrixXd& whitened(double const* const* p) const {
    Point point;
    point << Eigen::Map<const Eigen::Matrix<double, kRobotSize, 1>>(p[0]),
        Eigen::Map<const Eigen::Matrix<double, kTrackerSize, 1>>(p[1]),
        Eigen::Map<const Eigen::Matrix<double, kStartSize, 1>>(p[2]);
    if (columns_.size() && point == point_) return columns_;
    const TrackError::Linearised l = run_.at(p[0], p[1], p[2]);
    columns_.resize(l.error.size(), 1 + l.by.cols());
    columns_ << l.error, l.by;
    whitening_.apply(columns_);
    point_ = point;
    return columns_;
  }

  const TrackError& run_;
  const Whitening& whitening_;
  mutable Point point_;
  mutable Eigen::MatrixXd columns_;
};

// Value over standard deviation, of one block about zero.
template <int size>
class Prior : public ceres::SizedCostFunction<size, size> {
 public:
  explicit Prior(std::array<double, size> sd) : sd_(sd) {}
  bool Evaluate(double const* const* p, double* residuals, double** jacobians) const override {
    for (int i = 0; i < size; ++i) residuals[i] = p[0][i] / sd_[std::size_t(i)];
    if (!jacobians || !jacobians[0]) return true;
    std::fill(jacobians[0], jacobians[0] + std::ptrdiff_t(size) * size, 0.0);
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
      jacobians[0][2] = jacobians[0][3] = 0;
    }
    return true;
  }
  static constexpr double kSd = 1e-7;
};

class ScrubPrior : public ceres::SizedCostFunction<1, kRobotSize> {
 public:
  explicit ScrubPrior(double sd) : sd_(sd) {}
  bool Evaluate(double const* const* p, double* residuals, double** jacobians) const override {
    residuals[0] = p[0][3] / sd_;
    if (!jacobians || !jacobians[0]) return true;
    std::fill(jacobians[0], jacobians[0] + kRobotSize, 0.0);
    jacobians[0][3] = 1 / sd_;
    return true;
  }

 private:
  double sd_;
};

}  // namespace

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

double scrub_prior(const Model& m) { return m.scrub ? kUsualScrub : kNotFitted; }

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
  problem.AddResidualBlock(new ScrubPrior(scrub_prior(m)), nullptr, m.robot.data());
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

}  // namespace umbsim::calibration
