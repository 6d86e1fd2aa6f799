#include "gap/plan/signatures.h"

#include <tbb/parallel_for.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/error.h"

namespace umbsim::gap {
namespace {

using Tracks = std::vector<std::vector<Pose2>>;

constexpr int kBisections = 7;       // of the logarithm of a strength: to a few per cent of the whole range
constexpr double kMiss = 0.15;       // relative error of a severity that is called reached
constexpr double kNearEnough = 0.8;  // share of a severity below which the tracks do not show it

// What changes a track at each of its samples, carried along the nominal one to first order. Two effects that move the
// robot alike stay alike however large they are; differences of whole poses would tell them apart by their size.
Eigen::VectorXd first_order(const TrackFilter& filter, const std::vector<Pose2>& nominal,
                            const std::vector<Pose2>& changed) {
  const auto local = [](const Pose2& d) { return Eigen::Vector3d(d.x_m, d.y_m, d.theta_rad); };
  std::vector<Eigen::Vector3d> impulses{local(inverse(nominal[0]) * changed[0])};
  for (std::size_t k = 1; k < nominal.size(); ++k) {
    impulses.push_back(local(inverse(inverse(nominal[k - 1]) * nominal[k]) * (inverse(changed[k - 1]) * changed[k])));
  }
  return filter.propagate(impulses);
}

// Simulates hypotheses and looks at what they change.
class Workshop {
 public:
  Workshop(const Model& model, const std::vector<std::size_t>& counted, double radius_scatter)
      : model_(model),
        counted_(counted),
        floors_(model, counted, radius_scatter),
        nominal_(model.residuals(model.predict({{}}).front())) {}

  // An event of one run takes place in every run by turns: which one counts is decided when the set is known.
  Tracks tracks(const PlannedHypothesis& planned, const Eigen::VectorXd& p,
                const std::vector<std::size_t>& runs) const {
    Tracks result = model_.nominal().tracks;
    tbb::parallel_for(std::size_t(0), runs.size(), [&](std::size_t i) {
      std::vector<Effect> effects = effects_of(planned.hypothesis, p);
      if (planned.in_first_run) effects.front().values.run = model_.recording().runs[runs[i]].id;
      result[runs[i]] = model_.simulate_run(runs[i], effects);
    });
    return result;
  }

  SizeRows rows(const PlannedHypothesis& planned, Tracks tracks) const {
    if (planned.in_first_run) {
      for (std::size_t i = 1; i < counted_.size(); ++i) tracks[counted_[i]] = model_.nominal().tracks[counted_[i]];
    }
    return floors_.rows(tracks);
  }

  double severity(const PlannedHypothesis& planned, const Eigen::VectorXd& p) const {
    try {
      const SizeRows r = rows(planned, tracks(planned, p, counted_));
      return std::max(r.whole.norm(), r.steps.norm());
    } catch (const RunError&) {
      return 1e9;  // a robot that cannot be driven so
    }
  }

  // Whitened columns of one number for all runs, whose unit is `unit` of what was simulated.
  void add(const PlannedHypothesis& planned, const Eigen::VectorXd& p, double unit, Signature& signature,
           std::vector<Eigen::MatrixXd>& columns) const {
    const Tracks changed = tracks(planned, p, model_.all_runs());
    Predicted predicted =
        model_.predict({planned.in_first_run ? std::vector<Effect>{} : effects_of(planned.hypothesis, p)}).front();
    predicted.tracks = changed;
    const std::vector<Eigen::VectorXd> residual = model_.residuals(predicted);
    const SizeRows r = rows(planned, changed);
    append(signature.rows.whole, r.whole / unit);
    append(signature.rows.steps, r.steps / unit);
    Eigen::VectorXd features(0);
    for (std::size_t run = 0; run < columns.size(); ++run) {
      Eigen::VectorXd column = (nominal_[run] - residual[run]) / unit;
      const TrackFilter& filter = model_.filter(run);
      const Eigen::Index own = 3 * Eigen::Index(filter.samples());
      column.head(own) = filter.whiten(first_order(filter, model_.nominal().tracks[run], changed[run])) / unit;
      append(columns[run], column);
      if (std::find(counted_.begin(), counted_.end(), run) == counted_.end()) continue;
      const Eigen::Index more = column.size() - own;
      features.conservativeResize(features.size() + more);
      features.tail(more) = column.tail(more);
    }
    append(signature.features, features);
  }

 private:
  static void append(Eigen::MatrixXd& matrix, const Eigen::VectorXd& column) {
    matrix.conservativeResize(column.size(), matrix.cols() + 1);
    matrix.rightCols(1) = column;
  }

  const Model& model_;
  const std::vector<std::size_t>& counted_;
  NoiseFloors floors_;
  std::vector<Eigen::VectorXd> nominal_;
};

// The first parameter's value at which a bending effect has the wanted severity, or the strongest.
double bisected(const Workshop& shop, const PlannedHypothesis& planned, double wanted) {
  Eigen::VectorXd p = start_of(planned.hypothesis);
  const auto at = [&](double share) { return planned.weak * std::pow(planned.strong / planned.weak, share); };
  double low = 0;
  double high = 1;
  p[0] = at(high);
  if (shop.severity(planned, p) <= wanted) return p[0];
  for (int i = 0; i < kBisections; ++i) {
    const double middle = (low + high) / 2;
    p[0] = at(middle);
    const double size = shop.severity(planned, p);
    if (std::abs(size / wanted - 1) < kMiss) return p[0];
    (size > wanted ? high : low) = middle;
  }
  return at(low);
}

void add_bending(const Workshop& shop, double severity, Signature& s, std::vector<Eigen::MatrixXd>& columns) {
  Eigen::VectorXd p = start_of(s.planned.hypothesis);
  if (s.planned.happens && severity > 0) p[0] = bisected(shop, s.planned, severity);
  shop.add(s.planned, p, 1, s, columns);
  s.count = 1;
  s.prior_sd = Eigen::VectorXd::Ones(1);
  s.positive = {true};
  s.unit = p.head(1);
}

// A first estimate of where one number of a hypothesis has the wanted severity, by proportion from its step.
double by_proportion(const Workshop& shop, const PlannedHypothesis& planned, Eigen::Index i, double severity) {
  const FreeParameter& free = planned.hypothesis.parameters[std::size_t(i)];
  Eigen::VectorXd p = start_of(planned.hypothesis);
  p[i] += free.step;
  const double size = shop.severity(planned, p);
  double value = size > 1e-3 ? free.step * severity / size : free.step;
  const auto beyond = [&] {
    p[i] = value;
    return value > free.max || !plausible(effect_of(planned.hypothesis, p));
  };
  constexpr double kShrink = 0.8;
  while (value > free.step && beyond()) value *= kShrink;
  return value;
}

void add_proportional(const Workshop& shop, double severity, Signature& s, std::vector<Eigen::MatrixXd>& columns) {
  const auto& free = s.planned.hypothesis.parameters;
  s.count = int(free.size());
  s.prior_sd.resize(s.count);
  s.unit = Eigen::VectorXd::Ones(s.count);
  for (Eigen::Index i = 0; i < s.count; ++i) {
    const FreeParameter& f = free[std::size_t(i)];
    s.prior_sd[i] = f.prior_sd;
    s.positive.push_back(f.min >= 0);
    Eigen::VectorXd p = start_of(s.planned.hypothesis);
    // Down only: a step up would change nothing.
    const double step = f.max <= p[i] ? -f.step : f.step;
    p[i] += s.positive.back() && severity > 0 ? by_proportion(shop, s.planned, i, severity) : step;
    shop.add(s.planned, p, p[i] - f.start, s, columns);
  }
}

}  // namespace

namespace {

// Rows with the same sums of squares, as few as there are numbers.
Eigen::MatrixXd shortened(const Eigen::MatrixXd& rows) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> e(rows.transpose() * rows);
  return e.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal() * e.eigenvectors().transpose();
}

}  // namespace

double Signature::on_track(const Eigen::VectorXd& numbers) const {
  return std::max((rows.whole * numbers).norm(), (rows.steps * numbers).norm());
}

double Signature::severity(const Eigen::VectorXd& numbers) const {
  return std::max(on_track(numbers), features.size() > 0 ? (features * numbers).cwiseAbs().maxCoeff() : 0);
}

Eigen::VectorXd Signature::within_plausible(Eigen::VectorXd numbers) const {
  const auto beyond = [&] {
    for (Eigen::Index i = 0; i < numbers.size(); ++i) {
      const FreeParameter& f = planned.hypothesis.parameters[std::size_t(i)];
      if (numbers[i] < f.min || numbers[i] > f.max) return true;
    }
    return !plausible(effect_of(planned.hypothesis, numbers));
  };
  constexpr double kShrink = 0.9;
  for (int i = 0; i < 200 && beyond(); ++i) numbers *= kShrink;
  return numbers;
}

Eigen::VectorXd Signature::at_severity(const Eigen::VectorXd& direction, double wanted) const {
  // What was simulated at its size stays there.
  if (!planned.hypothesis.from_zero) return Eigen::VectorXd::Ones(1);
  if (!(severity(direction) > 0)) return direction;
  const double size = on_track(direction);
  if (size > 0) {
    const Eigen::VectorXd numbers = within_plausible(direction * (wanted / size));
    if (on_track(numbers) > kNearEnough * wanted) return numbers;
  }
  constexpr double kTypical = 0.5;  // of the most that is plausible
  constexpr double kFar = 1e6;
  return kTypical * within_plausible(kFar * direction / severity(direction));
}

Signatures::Signatures(const Model& model, const std::vector<PlannedHypothesis>& hypotheses,
                       const std::vector<std::size_t>& counted, double severity, double radius_scatter,
                       const std::function<void(double)>& done)
    : columns(model.recording().runs.size()) {
  const Workshop shop(model, counted, radius_scatter);
  for (const PlannedHypothesis& planned : hypotheses) {
    if (done) done(double(all.size()) / double(hypotheses.size()));
    Signature s;
    s.planned = planned;
    s.first = int(columns.front().cols());
    if (planned.hypothesis.from_zero)
      add_proportional(shop, severity, s, columns);
    else
      add_bending(shop, severity, s, columns);
    s.rows = {shortened(s.rows.whole), shortened(s.rows.steps)};
    all.push_back(std::move(s));
  }
  // In a model they stand with its first run, which need not be in every set.
  const Eigen::Index shared = Eigen::Index(std::tuple_size_v<CommandFeatures>);
  command_features = columns.front().bottomRows(shared);
  columns.front().bottomRows(shared).setZero();
}

}  // namespace umbsim::gap
