#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/error.h"
#include "gap/evidence/drivable.h"
#include "gap/evidence/impulsive_residuals.h"
#include "gap/hypotheses/local_starts.h"
#include "gap/search/local_search.h"
#include "gap/search/search.h"

namespace umbsim::gap {
namespace {

constexpr double kLeastImpulse = 10;  // log evidence below which a place or a moment would not pay
constexpr int kPastTheHill = 4;       // tries one after another that are each worse than the one before
constexpr double kTryCost = 3;  // log of how many frictions are tried, and for the width of what is held where it shows

// Effects on how the robot is driven and read are tried where counts or commands show them.
bool shown_by_command_features(const std::string& effect, const CommandFeatures& h) {
  if (effect == "encoder_sampling") return h[3] > 0;
  if (effect == "encoder_resolution") return h[4] < -0.1;
  return true;
}

// Where the fit of such an effect begins: at what counts or commands show. NaN: not such an effect.
double shown_start(const std::string& effect, const CommandFeatures& h) {
  if (effect == "over_acceleration") return h[0];
  if (effect == "fast_turning") return h[2];
  if (effect == "encoder_sampling") return h[3];
  if (effect == "encoder_resolution") return h[4];
  return std::nan("");
}

// What is seen at places and at moments, as strong as the strongest of `others` at most.
void no_stronger_than(const Impulses& others, Impulses& impulses) {
  const double place = others.places.empty() ? 0 : others.places.front().gain;
  const double moment = others.moments.empty() ? 0 : others.moments.front().gain;
  for (PlaceImpulse& p : impulses.places) p.gain = std::min(p.gain, place);
  for (Impulse& m : impulses.moments) m.gain = std::min(m.gain, moment);
}

// The leg that a moment belongs to, and the seconds since its start; before the first leg: leg 0.
std::pair<int, double> leg_at(const std::vector<Stretch>& stretches, double time_s) {
  std::pair<int, double> leg{0, 0};
  for (const Stretch& s : stretches) {
    if (s.kind == Stretch::Kind::leg && s.start_s <= time_s) leg = {s.leg, time_s - s.start_s};
  }
  return leg;
}

}  // namespace

Screen::Screen(const Model& model, const std::set<std::string>& excluded) : model_(model), excluded_(excluded) {
  const Recording& recording = model.recording();
  for (const Hypothesis& f :
       plain_hypotheses(1 / recording.encoder_rate_hz, recording.robot.ticks_per_revolution, model.wheel_width_m())) {
    if (excluded.count(f.effect) > 0 || !shown_by_command_features(f.effect, model.command_features())) continue;
    hypotheses_.push_back(f);
    // Samples that are rarer by a little already lag by up to a period: a longer interval says little of these.
    if (f.effect == "encoder_sampling") hypotheses_.back().parameters[0].step = model.command_features()[3];
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
      steps.push_back(1);
      sd.push_back(1);
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
// friction at which this robot begins to slip on these runs. Some per cent less already moves it by many noise floors.
void Screen::try_frictions(const Fit& fit, Candidate& c) const {
  c.gain = -1e9;
  if (model_.slips_at() == 0) return;
  const auto density = density_on(model_, fit, c.hypothesis, model_.one_of_each());
  double highest = -1e300;
  double last = -1e300;
  int down = 0;
  for (const double less :
       {-0.02, -0.01, 0.0, 0.01, 0.02, 0.035, 0.05, 0.07, 0.1, 0.14, 0.2, 0.28, 0.4, 0.6, 0.9, 1.3, 1.8, 2.5}) {
    const double friction = model_.slips_at() * std::exp(-less);
    const double there = density(Eigen::VectorXd::Constant(1, friction));
    down = there < last ? down + 1 : 0;
    last = there;
    if (down == kPastTheHill) break;
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

// Places and moments where something happened that `fit` leaves.
void Screen::offer_local(const Fit& fit, std::vector<Candidate>& candidates) const {
  Impulses impulses = find_impulses(model_, fit);
  if (another_) no_stronger_than(find_impulses(*another_, another_->held(fit)), impulses);
  const double R = model_.recording().robot.wheel_radius_m;
  // Two local events at once are not looked for: the second would mend the first one's shape.
  if (fit.is_local()) return;
  const auto offer = [&](Hypothesis hypothesis, const Starts& starts, const std::vector<double>& reach,
                         int local_searches, double gain, const std::vector<std::size_t>& shown_by = {}) {
    if (excluded_.count(hypothesis.effect) > 0) return;
    Candidate c;
    c.hypothesis = std::move(hypothesis);
    c.start = starts.front();
    c.starts = starts;
    c.reach = Eigen::Map<const Eigen::VectorXd>(reach.data(), Eigen::Index(reach.size()));
    c.local_searches = local_searches;
    // Where grip is missing the best start says little of the top of its hill.
    c.any_start = c.hypothesis.effect == "slippery_patch";
    c.gain = gain - c.hypothesis.search_cost;
    c.shown_by = shown_by;
    candidates.push_back(std::move(c));
  };
  for (std::size_t i = 0; i < std::min<std::size_t>(impulses.places.size(), 2); ++i) {
    const PlaceImpulse& k = impulses.places[i];
    if (k.gain < kLeastImpulse) break;
    if (k.lost_m > 0) {
      offer(bump_hypothesis(k.x_m, k.y_m, k.heading_rad), cable_starts(k.lost_m, R), {0.002, 0.02}, 2, k.gain,
            k.shown_by);
    }
    const bool closely = i == 0 && fit.hypotheses.empty();
    offer(lift_hypothesis(k.x_m, k.y_m), lift_starts(closely), {0.005, 0.01, 0.01}, closely ? 5 : 3, k.gain - 1,
          k.shown_by);
    const double grips = model_.slips_at() > 0 ? model_.slips_at() : 0.05;
    offer(patch_hypothesis(k.x_m, k.y_m), patch_starts(grips, closely), {0.02 * grips, 0.04, 0.04, 0.04},
          closely ? 3 : 1, k.gain - 2, k.shown_by);
  }
  if (impulses.moments.empty() || impulses.moments.front().gain < kLeastImpulse) return;
  const Impulse& k = impulses.moments.front();
  const RecordedRun& run = model_.recording().runs[k.run];
  const auto [leg, seconds] = leg_at(model_.stretches(k.run), run.truth[k.sample].time_s);
  if (leg == 0) return;
  const double kg = model_.mass_kg();
  offer(push_hypothesis(run.id, leg, std::max(0.0, std::round(seconds * 10 - 1) / 10), kg), push_starts(kg),
        {0.05 * kg, 0.05}, 2, k.gain);
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

std::vector<Screen::Candidate> Screen::on_top_of(const Fit& fit) const {
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
  std::vector<Candidate> candidates;
  for (std::size_t f = 0; f < hypotheses_.size(); ++f) {
    const auto [first, count] = range_[f];
    const bool there = std::any_of(fit.hypotheses.begin(), fit.hypotheses.end(),
                                   [&](const Hypothesis& g) { return g.effect == hypotheses_[f].effect; });
    if (there) continue;
    std::vector<int> columns = base;
    Eigen::VectorXd moved = Eigen::VectorXd::Zero(fixed + count);
    moved.head(fixed) = shift;
    for (int i = 0; i < count; ++i) columns.push_back(fixed + 1 + first + i);
    const Evidence e = evidence(grams, runs, columns, with_more(base_sds, prior_sd_.segment(first, count)), moved);
    Candidate c;
    c.hypothesis = hypotheses_[f];
    c.start = start_of(hypotheses_[f]);
    c.gain = e.log_density - without.log_density;
    bool possible = hypotheses_[f].from_zero;
    for (int i = 0; i < count; ++i) {
      const double mean = e.mean[fixed + i];
      if (!hypotheses_[f].from_zero) {
        if (mean < 0) c.gain = -1e9;  // it would have to act backwards
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
    if (possible) c.p_value = chi_squared_tail(misfit_without[e.prior] - e.misfit, count);
    if (const double shown = shown_start(c.hypothesis.effect, model_.command_features()); !std::isnan(shown)) {
      c.start[0] = std::clamp(shown, c.hypothesis.parameters[0].min, c.hypothesis.parameters[0].max);
      try_start(fit, c);
    }
    if (hypotheses_[f].effect == "slippery_floor") try_frictions(fit, c);
    c.gain += model_.log_chance({effect_of(c.hypothesis, c.start)});
    candidates.push_back(std::move(c));
  }
  offer_local(fit, candidates);
  std::sort(candidates.begin(), candidates.end(),
            [](const Candidate& a, const Candidate& b) { return a.gain > b.gain; });
  return candidates;
}

std::vector<std::size_t> worth_a_fit(const std::vector<Screen::Candidate>& singles) {
  constexpr std::size_t kFitted = 8;
  constexpr double kShown = 50;   // log evidence of a commanded motion in commands
  constexpr double kBehind = 15;  // log evidence
  std::vector<std::size_t> promising;
  for (std::size_t i = 0; i < singles.size(); ++i) {
    // Where the simulator bends, the screen is only a hint: such hypotheses are tried a little longer.
    if (singles[i].gain < (singles[i].hypothesis.from_zero ? 2 : 1)) continue;
    // What commands show is tried however much more the tracks say of something else.
    const bool shown = is_commanded_motion(singles[i].hypothesis.effect) && singles[i].gain > kShown;
    if (i >= kFitted && singles[i].gain < singles.front().gain - kBehind && !shown) continue;
    promising.push_back(i);
  }
  return promising;
}

}  // namespace umbsim::gap
