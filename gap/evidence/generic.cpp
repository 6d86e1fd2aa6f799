#include "gap/evidence/generic.h"

#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <functional>

namespace umbsim::gap {
namespace {

// Prior sizes of unexplained errors.
constexpr double kRate_pm = 1e-3;     // metres per metre, along and across; radians per metre
constexpr double kTurn = 3e-3;        // of a turn's angle
constexpr double kShift_m = 5e-4;     // of a turn, in each direction
constexpr double kRipple_rad = 5e-4;  // of heading, with the wheel's angle
constexpr int kRipples = 4;
constexpr double kDrift = 5e-3;      // metres per metre, in the floor's frame
constexpr double kTrend = 1e-3;      // of a radius, per run
constexpr double kOwnRadius = 2e-3;  // of a radius, in one run
constexpr double kNothing = 1e-12;   // standard deviation of what is not there
constexpr int kMostPatterns = 8;
constexpr double kModels = 3;                // that are tried
constexpr int kPatterns = kRipples + 2 + 2;  // ripples, drift, trends
constexpr double kLate_s = 0.01;             // by which what was counted and what was seen may be apart
constexpr int kLate = 5;

struct Raw {
  Eigen::MatrixXd patterns;
  Eigen::MatrixXd parts;
  Eigen::VectorXd parts_sd;
};

// What all runs would share: ripples of the heading with the wheels' angles, a drift in the floor's frame, radii that
// change from run to run.
Eigen::MatrixXd pattern_columns(const Model& model, std::size_t r, const std::vector<Impulses3>& ripples) {
  const auto& path = model.nominal().tracks[r];
  const TrackFilter& filter = model.filter(r);
  const std::size_t n = filter.samples();
  std::vector<Impulses3> impulses(kPatterns, Impulses3(n, Eigen::Vector3d::Zero()));
  std::copy(ripples.begin(), ripples.end(), impulses.begin());
  for (std::size_t i = 1; i < n; ++i) {
    const double rolled = model.nominal().rolled_m[r][i];
    const double theta = path[i].theta_rad;
    impulses[kRipples][i] = rolled * Eigen::Vector3d(std::cos(theta), -std::sin(theta), 0);
    impulses[kRipples + 1][i] = rolled * Eigen::Vector3d(std::sin(theta), std::cos(theta), 0);
  }
  // Both wheels' radii alike and against each other: the one shows in distances, the other in headings by much more.
  const Impulses3 left = radius_impulses(model.nominal(), r, 0);
  const Impulses3 right = radius_impulses(model.nominal(), r, 1);
  for (std::size_t i = 0; i < n; ++i) {
    impulses[kRipples + 2][i] = double(r) * (left[i] + right[i]);
    impulses[kRipples + 3][i] = double(r) * (right[i] - left[i]) / 2;
  }
  Eigen::MatrixXd columns(3 * Eigen::Index(n), kPatterns);
  for (int i = 0; i < kPatterns; ++i) columns.col(i) = filter.propagate(impulses[std::size_t(i)]);
  return columns;
}

// What was seen and what was counted at different moments, beyond one clock's offset: errors that go with the speed,
// and with its first and second difference from sample to sample, along the way and of the heading.
Eigen::MatrixXd late_columns(const Model& model, std::size_t r) {
  const std::vector<Eigen::Vector3d>& velocity = model.nominal().velocity[r];
  const std::size_t n = model.filter(r).samples();
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(3 * Eigen::Index(n), kLate);
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector3d here = velocity[i];
    const Eigen::Vector3d before = velocity[i > 0 ? i - 1 : 0];
    const Eigen::Vector3d after = velocity[std::min(i + 1, n - 1)];
    const Eigen::Vector3d change = (after - before) / 2;
    const Eigen::Vector3d bend = after - 2 * here + before;
    const Eigen::Index row = 3 * Eigen::Index(i);
    columns.row(row).head(2) << change[0], bend[0];
    columns.row(row + 2).tail(3) << here[2], change[2], bend[2];
  }
  return columns;
}

Raw raw_columns(const Model& model, std::size_t r) {
  const Recording& recording = model.recording();
  const auto& truth = recording.runs[r].truth;
  const auto& encoders = recording.runs[r].encoders;
  const auto& path = model.nominal().tracks[r];
  const auto& stretches = model.stretches(r);
  const TrackFilter& filter = model.filter(r);
  const std::size_t n = filter.samples();
  const double k = 2 * M_PI / recording.robot.ticks_per_revolution;
  std::vector<Impulses3> parts(3 * stretches.size(), Impulses3(n, Eigen::Vector3d::Zero()));
  std::vector<Impulses3> ripples(kRipples, Impulses3(n, Eigen::Vector3d::Zero()));
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
    for (std::size_t w = 0; w < 2; ++w) {
      ripples[2 * w][i][2] = std::cos(angle[w]) - std::cos(before[w]);
      ripples[2 * w + 1][i][2] = std::sin(angle[w]) - std::sin(before[w]);
      before[w] = angle[w];
    }
  }
  Raw raw{pattern_columns(model, r, ripples), Eigen::MatrixXd(3 * Eigen::Index(n), Eigen::Index(parts.size())),
          Eigen::VectorXd(Eigen::Index(parts.size()))};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    raw.parts.col(Eigen::Index(i)) = filter.propagate(parts[i]);
    const bool turn = stretches[i / 3].kind == Stretch::Kind::turn;
    raw.parts_sd[Eigen::Index(i)] = !turn ? kRate_pm : i % 3 == 2 ? kTurn : kShift_m;
  }
  return raw;
}

Eigen::VectorXd patterns_sd() {
  Eigen::VectorXd sd(kPatterns);
  sd << Eigen::VectorXd::Constant(kRipples, kRipple_rad), kDrift, kDrift, kTrend, kTrend;
  return sd;
}

// Patterns one after another, as long as the next one pays for having been picked among all. `sd`: of the nuisances and
// of the patterns, where there are none.
double shared_density(const Model& model, const std::vector<RunGram>& grams, Eigen::VectorXd sd) {
  Eigen::VectorXd wide(sd.size());
  wide << model.unexplained_sd(), patterns_sd();
  const auto density = [&] { return evidence(grams, model.all_runs(), first_columns(sd.size()), sd).log_density; };
  double best = density();
  for (int round = 0; round < kMostPatterns; ++round) {
    Eigen::Index next = -1;
    double with = best + std::log(double(sd.size()));
    for (Eigen::Index i = 0; i < sd.size(); ++i) {
      const double narrow = sd[i];
      if (wide[i] <= narrow) continue;
      sd[i] = wide[i];
      if (const double d = density(); d > with) {
        with = d;
        next = i;
      }
      sd[i] = narrow;
    }
    if (next < 0) break;
    best = with - std::log(double(sd.size()));
    sd[next] = wide[next];
  }
  return best;
}

// Whitened, with zeros below where counts stand against commands.
Eigen::MatrixXd whitened(const Model& model, std::size_t r, const Eigen::MatrixXd& raw, Eigen::Index rows) {
  Eigen::MatrixXd white = Eigen::MatrixXd::Zero(rows, raw.cols());
  white.topRows(raw.rows()) = model.filter(r).whiten(raw);
  return white;
}

// Of the nuisances and of columns of given sizes, under each prior that the nuisances may have.
double density_of(const Model& model, const std::vector<RunGram>& grams, const Eigen::VectorXd& sizes = {}) {
  const std::vector<int> columns = first_columns(model.nuisances() + sizes.size());
  return evidence(grams, model.all_runs(), columns, with_more(model.nuisance_sds(), sizes)).log_density;
}

// The density of patterns under whichever prior of the nuisances gives more of it.
double density_of_patterns(const Model& model, const std::vector<RunGram>& grams) {
  double most = -1e300;
  for (const Eigen::VectorXd& sd : with_more(model.nuisance_sds(), Eigen::VectorXd::Constant(kPatterns, kNothing))) {
    most = std::max(most, shared_density(model, grams, sd));
  }
  return most - std::log(double(model.nuisance_sds().size()));
}

// Log evidence for columns that all runs share, given for each run and with the sizes that they may have, on top of a
// fit.
double gain_of(const Model& model, const Fit& fit, const std::function<Eigen::MatrixXd(std::size_t)>& raw,
               const Eigen::VectorXd& sizes) {
  const std::size_t runs = model.recording().runs.size();
  const std::vector<Eigen::VectorXd> residual = model.residuals(fit.predicted);
  std::vector<Eigen::MatrixXd> columns(runs);
  tbb::parallel_for(std::size_t(0), runs,
                    [&](std::size_t r) { columns[r] = whitened(model, r, raw(r), residual[r].size()); });
  return density_of(model, model.grams(residual, columns), sizes) - density_of(model, model.grams(residual, {}));
}

}  // namespace

double steady_gain(const Model& model, const Fit& fit) {
  return gain_of(
      model, fit, [&](std::size_t r) { return raw_columns(model, r).patterns; }, patterns_sd());
}

double late_gain(const Model& model, const Fit& fit) {
  return gain_of(
      model, fit, [&](std::size_t r) { return late_columns(model, r); }, Eigen::VectorXd::Constant(kLate, kLate_s));
}

double generic_gain(const Model& model, const Fit& fit) {
  const std::size_t runs = model.recording().runs.size();
  const std::vector<Eigen::VectorXd> residual = model.residuals(fit.predicted);
  std::vector<Eigen::MatrixXd> patterns(runs);
  std::vector<LocalColumns> parts(runs);
  std::vector<LocalColumns> radii(runs);
  tbb::parallel_for(std::size_t(0), runs, [&](std::size_t r) {
    const Raw raw = raw_columns(model, r);
    patterns[r] = whitened(model, r, raw.patterns, residual[r].size());
    parts[r].columns = whitened(model, r, raw.parts, residual[r].size());
    parts[r].prior_sd = raw.parts_sd;
    radii[r] = {model.own_columns(r).leftCols(2), Eigen::VectorXd::Constant(2, kOwnRadius)};
  });
  const Eigen::VectorXd rippled = Eigen::VectorXd::Constant(kRipples, kRipple_rad);
  const double best = std::max({density_of_patterns(model, model.grams(residual, patterns)),
                                density_of(model, model.grams(residual, {}, radii)),
                                density_of(model, model.grams(residual, patterns, parts), rippled)});
  return best - std::log(kModels) - density_of(model, model.grams(residual, {}));
}

}  // namespace umbsim::gap
