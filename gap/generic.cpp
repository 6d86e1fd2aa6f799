#include "gap/generic.h"

#include <cmath>

#include <Eigen/Cholesky>
#include <tbb/parallel_for.h>

namespace umbsim::gap {
namespace {

// Prior sizes of unexplained errors.
constexpr double kRate_pm = 1e-3;     // metres per metre, along and across; radians per metre
constexpr double kTurn = 3e-3;        // of a turn's angle
constexpr double kShift_m = 5e-4;     // of a turn, in each direction
constexpr double kRipple_rad = 5e-4;  // of heading, with the wheel's angle
constexpr int kRipples = 4;

struct Raw {
  Eigen::MatrixXd ripples;
  Eigen::MatrixXd parts;
  Eigen::VectorXd parts_sd;
};

Raw raw_columns(const Model& model, std::size_t r) {
  const Recording& recording = model.recording();
  const auto& truth = recording.runs[r].truth;
  const auto& encoders = recording.runs[r].encoders;
  const auto& path = model.nominal().tracks[r];
  const auto& stretches = model.stretches(r);
  const TrackFilter& filter = model.filter(r);
  const std::size_t n = filter.samples();
  const double k = 2 * M_PI / recording.robot.ticks_per_revolution;
  using Kicks = std::vector<Eigen::Vector3d>;
  std::vector<Kicks> parts(3 * stretches.size(), Kicks(n, Eigen::Vector3d::Zero()));
  std::vector<Kicks> ripples(kRipples, Kicks(n, Eigen::Vector3d::Zero()));
  std::size_t stretch = 0;
  std::size_t e = 0;
  double before[2] = {0, 0};
  for (std::size_t i = 1; i < n; ++i) {
    while (stretch + 1 < stretches.size() && stretches[stretch].end_s < truth[i].time_s - 1e-6) ++stretch;
    while (e + 1 < encoders.size() && encoders[e].time_s < truth[i].time_s) ++e;
    const Stretch& s = stretches[stretch];
    const Pose2 u = inverse(path[i - 1]) * path[i];
    const double rolled = model.nominal().rolled_m[r][i];
    const bool turn = s.kind == Stretch::Kind::turn;
    const double share = turn ? std::abs(u.theta_rad) / std::max(0.1, std::abs(s.angle_rad)) : rolled;
    parts[3 * stretch][i][0] = share;
    parts[3 * stretch + 1][i][1] = share;
    parts[3 * stretch + 2][i][2] = turn ? u.theta_rad : rolled;
    const double angle[2] = {k * double(encoders[e].left_ticks), k * double(encoders[e].right_ticks)};
    for (int w = 0; w < 2; ++w) {
      ripples[std::size_t(2 * w)][i][2] = std::cos(angle[w]) - std::cos(before[w]);
      ripples[std::size_t(2 * w + 1)][i][2] = std::sin(angle[w]) - std::sin(before[w]);
      before[w] = angle[w];
    }
  }
  Raw raw{Eigen::MatrixXd(3 * Eigen::Index(n), kRipples),
          Eigen::MatrixXd(3 * Eigen::Index(n), Eigen::Index(parts.size())),
          Eigen::VectorXd(Eigen::Index(parts.size()))};
  for (int i = 0; i < kRipples; ++i) raw.ripples.col(i) = filter.propagate(ripples[std::size_t(i)]);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    raw.parts.col(Eigen::Index(i)) = filter.propagate(parts[i]);
    const bool turn = stretches[i / 3].kind == Stretch::Kind::turn;
    raw.parts_sd[Eigen::Index(i)] = !turn ? kRate_pm : i % 3 == 2 ? kTurn : kShift_m;
  }
  return raw;
}

}  // namespace

double generic_gain(const Model& model, const Fit& fit) {
  const std::size_t runs = model.recording().runs.size();
  const std::vector<Eigen::VectorXd> residual = model.residuals(fit.predicted);
  std::vector<Eigen::MatrixXd> ripples(runs);
  std::vector<LocalColumns> parts(runs);
  tbb::parallel_for(std::size_t(0), runs, [&](std::size_t r) {
    const Raw raw = raw_columns(model, r);
    ripples[r] = Eigen::MatrixXd::Zero(residual[r].size(), kRipples);
    ripples[r].topRows(raw.ripples.rows()) = model.filter(r).whiten(raw.ripples);
    parts[r].columns = Eigen::MatrixXd::Zero(residual[r].size(), raw.parts.cols());
    parts[r].columns.topRows(raw.parts.rows()) = model.filter(r).whiten(raw.parts);
    parts[r].prior_sd = raw.parts_sd;
  });
  const std::vector<RunGram> with = model.grams(residual, ripples, parts);
  const std::vector<RunGram> without = model.grams(residual, {});
  Eigen::VectorXd sd(model.nuisances() + kRipples);
  sd << model.nuisance_sd(), Eigen::VectorXd::Constant(kRipples, kRipple_rad);
  std::vector<int> columns;
  for (int i = 1; i <= int(sd.size()); ++i) columns.push_back(i);
  const std::vector<int> nuisances(columns.begin(), columns.begin() + model.nuisances());
  return evidence(with, model.all_runs(), columns, sd).log_density -
         evidence(without, model.all_runs(), nuisances, model.nuisance_sd()).log_density;
}

}  // namespace umbsim::gap
