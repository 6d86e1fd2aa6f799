#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "core/error.h"
#include "core/probability.h"
#include "gap/search/drivable.h"
#include "gap/search/local_search.h"
#include "gap/search/search.h"

namespace umbsim::gap {
namespace {

// Frictions that are tried, as logarithms below the first at which wheels slip: steps in proportion, up to a bound.
constexpr double kFriction = 0.4, kMostFriction = 0.08, kSlippiest = 1.8;
// Tyres that are tried, as logarithms beside the usual ones, and how much more of what scrubs.
constexpr double kSofterAlong = 1.4, kHarderAcross = 1.2, kMoreScrub = 3;
constexpr double kTryCost = 3;  // log of how many frictions are tried, and for the width of what is held where it shows

// Effects on how the robot is driven and read are tried where counts or commands show them.
bool may_show(const std::string& effect, const CommandFeatures& features) {
  const ShownBy& shown = traits_of(effect).shown;
  if (shown.feature < 0) return true;
  const double at = features[std::size_t(shown.feature)];
  return shown.above < at && at < shown.below;
}

// Where the fit of such an effect begins: at what counts or commands show.
std::optional<double> shown_start(const std::string& effect, const CommandFeatures& features) {
  const int feature = traits_of(effect).shown.feature;
  return feature < 0 ? std::nullopt : std::optional(features[std::size_t(feature)]);
}

// Whether an effect that bends is taken to act in proportion up to its start: it has one number, and no threshold.
bool by_secant(const Hypothesis& h) { return !h.from_zero && h.parameters.size() == 1 && !is(h.effect, kThreshold); }

}  // namespace

Screen::Screen(const Model& model, const std::set<std::string>& excluded) : model_(model), excluded_(excluded) {
  const Recording& recording = model.recording();
  for (const Hypothesis& f : plain_hypotheses(1 / recording.encoder_rate_hz, recording.robot.ticks_per_revolution,
                                              model.wheel_width_m(), model.motor_inertia_kgm2(), model.mass_kg())) {
    if (excluded.count(f.effect) > 0 || !may_show(f.effect, model.command_features())) continue;
    hypotheses_.push_back(f);
    // Samples that are rarer by a little already lag by up to a period: a longer interval says little of these.
    if (is(f.effect, kFromWhatShows))
      hypotheses_.back().parameters[0].step = *shown_start(f.effect, model.command_features());
  }
  try {
    simulate_steps();
  } catch (const std::runtime_error&) {  // RunError or InputError: not every hypothesis suits every robot
    hypotheses_ = drivable(model, std::move(hypotheses_));
    simulate_steps();
  }
}

void Screen::simulate_steps() {
  range_.clear();
  std::vector<std::vector<Effect>> stepped;
  std::vector<double> steps;
  std::vector<double> sd;
  for (const Hypothesis& f : hypotheses_) {
    range_.push_back({int(steps.size()), f.from_zero ? int(f.parameters.size()) : 1});
    if (!f.from_zero) {
      stepped.push_back(effects_of(f, start_of(f)));
      steps.push_back(by_secant(f) ? f.parameters[0].start : 1);
      sd.push_back(by_secant(f) ? f.parameters[0].prior_sd : 1);
      continue;
    }
    for (std::size_t i = 0; i < f.parameters.size(); ++i) {
      Eigen::VectorXd p = start_of(f);
      p[Eigen::Index(i)] += f.parameters[i].step;
      stepped.push_back(effects_of(f, p));
      steps.push_back(f.parameters[i].step);
      sd.push_back(f.parameters[i].prior_sd);
    }
  }
  columns_ = model_.columns(model_.none().predicted, model_.predict(stepped), steps);
  prior_sd_ = Eigen::Map<Eigen::VectorXd>(sd.data(), Eigen::Index(sd.size()));
}

// Wheels let go all at once: no derivative says how much grip is missing, so that it is tried, in shares below the
// friction at which this robot begins to slip on these runs. Some per cent less already moves it by many noise floors,
// and what explains most may lie far below, behind frictions that explain less than none.
void Screen::try_frictions(const Fit& fit, Candidate& c) const {
  c.gain = -1e9;
  if (model_.slips_at() == 0) return;
  const std::vector<std::size_t> runs = model_.one_of_each();
  const auto density = density_beside(model_, fit, c.hypothesis, runs);
  const auto at_most = density_beside(model_, fit, c.hypothesis, {runs.front()});  // further runs only take from it
  double highest = -1e300;
  for (double less = -0.02; less < kSlippiest; less += std::clamp(kFriction * less, 0.01, kMostFriction)) {
    const double friction = model_.slips_at() * std::exp(-less);
    const Eigen::VectorXd numbers = Eigen::VectorXd::Constant(1, friction);
    if (at_most(numbers) <= highest) continue;
    const double there = density(numbers);
    if (there <= highest) continue;
    highest = there;
    c.start[0] = friction;
    c.reach = Eigen::VectorXd::Constant(1, 0.01 * friction);
  }
  c.gain = density_on(model_, fit, c.hypothesis)(c.start) - model_.density_at(fit.hypotheses, fit.p) - kTryCost;
}

// What counts and commands show is tried as it is: beside another effect the derivatives see little of it.
void Screen::try_start(const Fit& fit, Candidate& c) const {
  const double before = model_.density_at(fit.hypotheses, fit.p);
  c.gain = std::max(c.gain, density_on(model_, fit, c.hypothesis)(c.start) - before - kTryCost);
}

// How softly tyres grip moves what scrubs by orders of magnitude, and from hard tyres no derivative leads to soft ones:
// a few of both are tried, with little and much scrub either way, on a few runs.
void Screen::offer_tyres(const Fit& fit, Candidate& c) const {
  const Eigen::Index own = c.start.size() - 2;
  for (const double along : {0.0, kSofterAlong}) {
    for (const double across : {0.0, -kHarderAcross}) {
      for (const double size : {-kMoreScrub, -1.0, 1.0, kMoreScrub}) {
        Eigen::VectorXd start = c.start;
        start.head(own) *= size;
        start.tail<2>() << along, across;
        c.starts.push_back(std::move(start));
      }
    }
  }
  c.shown_by = model_.one_of_each();
  const double before = model_.density_at(fit.hypotheses, fit.p);
  c.gain = std::max(c.gain, keep_best_starts(model_, fit, c) - before - kTryCost);
}

std::optional<Linearisation> Screen::near(const Fit& fit, const Hypothesis& hypothesis) const {
  const auto same = [&](const Hypothesis& f) {
    return f.effect == hypothesis.effect && f.variant == hypothesis.variant;
  };
  const auto at = std::find_if(hypotheses_.begin(), hypotheses_.end(), same);
  if (at == hypotheses_.end() || !at->from_zero) return std::nullopt;
  const auto [first, count] = range_[std::size_t(at - hypotheses_.begin())];
  Linearisation near{Eigen::VectorXd(fit.p.size() + count), model_.residuals(fit.predicted), {}};
  near.p << fit.p, start_of(hypothesis);
  for (std::size_t r = 0; r < columns_.size(); ++r) {
    Eigen::MatrixXd both(columns_[r].rows(), fit.p.size() + count);
    if (fit.p.size() > 0) both.leftCols(fit.p.size()) = fit.columns[r];
    both.rightCols(count) = columns_[r].middleCols(first, count);
    near.columns.push_back(std::move(both));
  }
  return near;
}

std::vector<Screen::Candidate> Screen::by_derivatives(const Fit& fit,
                                                      const std::function<bool(const Hypothesis&)>& chosen) const {
  const auto residual = model_.residuals(fit.predicted);
  const Eigen::Index own = fit.p.size();
  std::vector<Eigen::MatrixXd> all(columns_.size());
  for (std::size_t r = 0; r < all.size(); ++r) {
    all[r].resize(columns_[r].rows(), own + columns_[r].cols());
    if (own > 0) all[r].leftCols(own) = fit.columns[r];
    all[r].rightCols(columns_[r].cols()) = columns_[r];
  }
  const std::vector<RunGram> grams = model_.grams(residual, all);
  const int fixed = model_.nuisances() + int(own);
  std::vector<int> base;
  for (int i = 1; i <= fixed; ++i) base.push_back(i);
  const std::vector<Eigen::VectorXd> base_sds = with_more(model_.nuisance_sds(), prior_sd_of(fit.hypotheses));
  Eigen::VectorXd shift = Eigen::VectorXd::Zero(fixed);
  shift.tail(own) = fit.p;
  const auto runs = model_.all_runs();
  const Evidence without = evidence(grams, runs, base, base_sds, shift);
  std::vector<double> misfit_without;
  for (const Eigen::VectorXd& sd : base_sds) misfit_without.push_back(evidence(grams, runs, base, sd, shift).misfit);
  const auto with = [&](int first, int count) {
    std::vector<int> columns = base;
    Eigen::VectorXd moved = Eigen::VectorXd::Zero(fixed + count);
    moved.head(fixed) = shift;
    for (int i = 0; i < count; ++i) columns.push_back(fixed + 1 + first + i);
    return evidence(grams, runs, columns, with_more(base_sds, prior_sd_.segment(first, count)), moved);
  };
  std::vector<Candidate> candidates;
  for (std::size_t f = 0; f < hypotheses_.size(); ++f) {
    const auto [first, count] = range_[f];
    const bool there = std::any_of(fit.hypotheses.begin(), fit.hypotheses.end(),
                                   [&](const Hypothesis& g) { return g.effect == hypotheses_[f].effect; });
    if (there || !chosen(hypotheses_[f])) continue;
    // What goes with an effect is not credited to it: it stays as it begins.
    const int offered = hypotheses_[f].from_zero ? count - hypotheses_[f].of_others : count;
    const Evidence e = with(first, offered);
    Candidate c;
    c.hypothesis = hypotheses_[f];
    c.start = start_of(hypotheses_[f]);
    c.gain = e.log_density - without.log_density;
    bool possible = hypotheses_[f].from_zero;
    for (int i = 0; i < offered; ++i) {
      const double mean = e.mean[fixed + i];
      if (!hypotheses_[f].from_zero) {
        if (mean < 0) c.gain = -1e9;  // it would have to act backwards
        if (mean > 0 && by_secant(hypotheses_[f])) c.start[0] = std::min(mean, hypotheses_[f].parameters[0].max);
        continue;
      }
      const FreeParameter& p = hypotheses_[f].parameters[std::size_t(i)];
      c.start[i] = std::clamp(mean, p.min, p.max);
      if (p.min >= 0 && mean < 0) {
        const double sigmas = mean / std::sqrt(e.covariance(fixed + i, fixed + i));
        c.gain -= 0.5 * sigmas * sigmas;
        possible = false;
      }
    }
    if (c.hypothesis.likelier) c.hypothesis.likelier(c.start);
    if (possible) c.p_value = chi_squared_tail(misfit_without[e.prior] - e.misfit, offered);
    candidates.push_back(std::move(c));
  }
  return candidates;
}

std::vector<Screen::Candidate> Screen::on_top_of(const Fit& fit) const {
  std::vector<Candidate> candidates = by_derivatives(fit, [](const Hypothesis&) { return true; });
  for (Candidate& c : candidates) {
    if (const auto shown = shown_start(c.hypothesis.effect, model_.command_features())) {
      c.start[0] = std::clamp(*shown, c.hypothesis.parameters[0].min, c.hypothesis.parameters[0].max);
      try_start(fit, c);
    }
    if (is(c.hypothesis.effect, kThreshold)) try_frictions(fit, c);
    if (is(c.hypothesis.effect, kScrubs) && c.hypothesis.with) offer_tyres(fit, c);
    c.gain += model_.log_chance({effect_of(c.hypothesis, c.start)});
  }
  offer_local(fit, candidates);
  std::sort(candidates.begin(), candidates.end(),
            [](const Candidate& a, const Candidate& b) { return a.gain > b.gain; });
  return candidates;
}

std::vector<std::size_t> worth_a_fit(const std::vector<Screen::Candidate>& singles) {
  constexpr std::size_t kFitted = 8;
  constexpr double kShown = 50;   // log evidence of what counts or commands show
  constexpr double kBehind = 15;  // log evidence
  std::vector<std::size_t> promising;
  for (std::size_t i = 0; i < singles.size(); ++i) {
    // Where the simulator bends, the screen is only a hint: such hypotheses are tried a little longer.
    if (singles[i].gain < (singles[i].hypothesis.from_zero ? 2 : 1)) continue;
    // What commands show is tried however much more the tracks say of something else, and so is what rolls and counts
    // show: where readings come late, the nuisance that does the same hides most of what is gained.
    const Hypothesis& h = singles[i].hypothesis;
    const bool shown =
        (is_commanded_motion(h.effect) || (is_kinematic(h.effect) && shows_in_counts(h))) && singles[i].gain > kShown;
    if (i >= kFitted && singles[i].gain < singles.front().gain - kBehind && !shown) continue;
    promising.push_back(i);
  }
  return promising;
}

}  // namespace umbsim::gap
