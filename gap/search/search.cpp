#include "gap/search/search.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/error.h"
#include "gap/noise/noise_floor.h"
#include "gap/search/forward_search.h"
#include "gap/search/frontier.h"
#include "gap/search/local_search.h"

namespace umbsim::gap {
namespace {

constexpr std::size_t kAdditionsFitted = 5;
constexpr std::size_t kLocalSearches = 3;
constexpr Descending kFewerRounds{4};        // what is there already has been fitted
constexpr Descending kFromTop{2, 1.0 / 64};  // where a search ended
constexpr double kAnotherVariant = 3;        // log evidence by which a second hypothesis of one effect may promise less
constexpr double kLocalHint = 0.25;          // of what explains all, below which no place or moment is searched for
constexpr double kWorthASearch = 0.1;        // of what the best single effect explains, the same of the best start
constexpr double kNearRival = 0.4;           // of what the best place or moment explains, the same of another's start
constexpr double kPartOfNeeded = 0.25;       // of what a further effect must bring, the same of its best start
constexpr double kDoubtful = 0.3;            // of what a further effect must bring
constexpr double kScreening = 0.2;           // of the time of single effects
constexpr double kAdding = 0.75;             // of a stage's time that further effects take; the rest are exchanges

}  // namespace

Found ForwardSearch::run() {
  begin("fitting single effects");
  fit_singles();
  if (model_.tracker_is_free()) fit_dimensions();
  std::vector<Fit> frontier(fits_.begin() + 1, fits_.end());
  for (int depth = 2; depth <= thresholds_.most_effects; ++depth) {
    const std::vector<Fit> from = bases(model_, none_, std::exchange(frontier, {}), thresholds_);
    if (from.empty() || from.front().log_evidence < none_.log_evidence + thresholds_.detect) break;
    begin(depth == 2 ? "fitting pairs of effects" : "fitting combinations of three");
    for (std::size_t i = 0; i < from.size(); ++i) {
      add_to(from[i], kAdditionsFitted, {kAdding * double(i) / double(from.size()), kAdding / double(from.size())},
             frontier);
    }
    if (frontier.empty()) break;
    done(kAdding);
    swap(frontier);
  }
  return {std::move(fits_), std::move(doubtful_), std::move(p_values_)};
}

void ForwardSearch::begin(const std::string& stage) {
  stage_ = stage;
  done(0);
}

std::optional<Fit> ForwardSearch::tried(const Fit& base, const Screen::Candidate& c, double least) {
  std::vector<Hypothesis> hypotheses = base.hypotheses;
  hypotheses.push_back(c.hypothesis);
  try {
    const std::optional<Eigen::VectorXd> from = searched_start(model_, base, c, least);
    if (!from) return std::nullopt;
    Eigen::VectorXd start(base.p.size() + from->size());
    start << base.p, *from;
    const bool searched = c.reach.size() > 0;
    const Descending descending = !base.hypotheses.empty() ? kFewerRounds : searched ? kFromTop : Descending{};
    Fit fit = model_.fit(hypotheses, start, descending, {}, screen_.near(base, c.hypothesis));
    // A place may have been fitted so that it makes up for what is only now beside it. What takes part in the contact
    // would mend how another engine's robot is shaken there.
    if (base.is_local() && is_kinematic(c.hypothesis.effect) && c.gain > thresholds_.addition) {
      fit = with_place_searched_again(model_, fit);
    }
    fit.size = displacement_m(fit.predicted.tracks, base.predicted.tracks) / model_.noise_floor_m();
    fit.seen = std::sqrt(seen_between(model_, base, fit) / model_.rows());
    if (contradicted(model_, base, fit)) return std::nullopt;
    // What goes with an effect is not credited to it: soft tyres explain much, whatever rolls on them.
    if (c.hypothesis.of_others > 0 && fit.own_evidence() < thresholds_.detect) return std::nullopt;
    if (large_enough(base, fit)) return fit;
    keep_doubtful(base, addition_needed(model_, base, none_, thresholds_), std::move(fit));
  } catch (const RunError&) {
    // A robot that cannot be simulated is no explanation,
  } catch (const InputError&) {
    // nor is one that does not stand at its start, on a cable or without a wheel's floor.
  }
  return std::nullopt;
}

void ForwardSearch::keep_doubtful(const Fit& base, const Needed& needed, Fit fit) {
  if (base.hypotheses.empty() || pays(model_, base, fit, needed, kDoubtful)) doubtful_.push_back(std::move(fit));
}

bool ForwardSearch::large_enough(const Fit& base, const Fit& fit) const {
  // Beside a free tracker's frame and clock a robot is as far from the simulator as the nuisances say, however far
  // its noise makes it stray. What moves counts against commands, and not the robot, is seen there.
  if (model_.tracker_is_free() && !base.hypotheses.empty()) return true;
  const bool alone = base.hypotheses.empty();
  if (fit.size >= (alone ? thresholds_.smallest : thresholds_.smallest_addition)) return true;
  // Motors and encoders may move the robot nowhere, where counts and commands are nearer with them.
  const Hypothesis& added = fit.hypotheses.back();
  const bool drive = shows_in_counts(added);
  if (drive && model_.counts_misfit(fit) < model_.counts_misfit(base)) return true;
  // Any engine shakes a robot otherwise than this one, at a place and beside another effect most of all: that is no
  // cause, unless it is play.
  return fit.seen >= thresholds_.least_seen && (alone ? !fit.is_local() : drive && !is_kinematic(added.effect));
}

void ForwardSearch::fit_singles() {
  std::vector<Screen::Candidate> singles = screen_.on_top_of(none_);
  for (const Screen::Candidate& c : singles) {
    const auto [of_effect, fresh] = p_values_.try_emplace(c.hypothesis.effect, c.p_value);
    if (!fresh) of_effect->second = std::min(of_effect->second, c.p_value);
  }
  fit_promising(singles, false, {kScreening, (1 - kScreening) / 2});
  fit_promising(singles, true, {(1 + kScreening) / 2, (1 - kScreening) / 2});
}

// `local`: places and moments, or all others.
void ForwardSearch::fit_promising(std::vector<Screen::Candidate>& singles, bool local, Part part) {
  std::vector<std::size_t> promising = worth_a_fit(singles);
  std::erase_if(promising, [&](std::size_t i) { return (singles[i].hypothesis.search_cost > 0) != local; });
  // Where most is promised for a start first: what is found there spares others their search.
  const auto promises_more = [&](std::size_t a, std::size_t b) {
    return singles[a].gain * double(singles[b].starts.size()) > singles[b].gain * double(singles[a].starts.size());
  };
  if (local) std::stable_sort(promising.begin(), promising.end(), promises_more);
  double most_local = 0;
  for (std::size_t i = 0; i < promising.size(); ++i) {
    done(part.from + part.size * double(i) / double(promising.size()));
    Screen::Candidate& c = singles[promising[i]];
    const double most = std::max_element(fits_.begin(), fits_.end(), less_evidence)->log_evidence - none_.log_evidence;
    if (local && idle(c, most)) continue;
    const double least = none_.log_evidence + std::max({kWorthASearch * most, kNearRival * most_local,
                                                        c.hypothesis.search_cost + thresholds_.effect_cost});
    auto fit = tried(none_, c, least);
    if (!fit) continue;
    if (local) most_local = std::max(most_local, fit->log_evidence - none_.log_evidence);
    fits_.push_back(std::move(*fit));
  }
}

// No real robot is built to its drawing: the dimensions that every calibration is about are fitted together before
// anything else is looked for, each as long as it pays for its number.
void ForwardSearch::fit_dimensions() {
  Fit base = none_;
  for (;;) {
    std::optional<Fit> best;
    for (const Screen::Candidate& c : screen_.on_top_of(base)) {
      if (!is_dimension(c.hypothesis.effect)) continue;
      auto fit = tried(base, c, -1e300);
      if (fit && (!best || fit->log_evidence > best->log_evidence)) best = std::move(fit);
    }
    if (!best || best->log_evidence < base.log_evidence + thresholds_.effect_cost) break;
    base = std::move(*best);
    if (base.hypotheses.size() > 1) fits_.push_back(base);
  }
  // Each may stand for another effect that moves the robot much as it does: counts lost by one wheel for its radius.
  if (base.hypotheses.size() > 1) {
    for (std::size_t out = 0; out < base.hypotheses.size(); ++out) exchange(base, out, fits_);
  }
}

// Places and moments take many simulations: not alone where another effect explains far more than the matched filter
// sees of them (they are looked for beside it), nor where something else explains all that noise does not, and more
// than they do where they begin. What was found at a place or a moment is none of these: the filter does not tell what
// it is. `most`: what the best of all fits explains.
bool ForwardSearch::idle(Screen::Candidate& c, double most) const {
  if (c.gain < kLocalHint * kWorthASearch * most) return true;
  double rival = -1e300;
  for (const Fit& f : fits_) {
    if (!f.is_local() && explains_all(model_, f, none_, thresholds_))
      rival = std::max(rival, f.log_evidence - none_.log_evidence);
  }
  if (rival < c.gain) return false;
  if (c.gain < kLocalHint * rival) return true;
  return keep_best_starts(model_, none_, c) - none_.log_evidence < rival;
}

// Fits of `base` and one effect more that pay; `most`: that are fitted.
void ForwardSearch::add_to(const Fit& base, std::size_t most, Part part, std::vector<Fit>& paying) {
  const Needed needed = addition_needed(model_, base, none_, thresholds_);
  const double held = model_.density_at(base.hypotheses, base.p);
  std::size_t fitted = 0;
  std::size_t local_searches = 0;
  std::map<std::string, double> tried_gain;
  std::vector<Fit> found;
  for (const Screen::Candidate& c : screen_.on_top_of(base)) {
    if (fitted == most) break;
    const auto [first, fresh] = tried_gain.try_emplace(c.hypothesis.effect, c.gain);
    if (!fresh && c.gain < first->second - kAnotherVariant) continue;
    // A local search for a place or a moment takes more simulations than all other fits.
    if (c.reach.size() > 1 && local_searches == kLocalSearches) continue;
    const bool counts = shows_in_counts(c.hypothesis);
    const double hint = counts ? std::min(needed.hint, 0.5 * needed.counts) : needed.hint;
    if (c.gain < (c.hypothesis.search_cost > 0 ? 0.5 * needed.local : hint)) continue;
    if (c.reach.size() > 1) ++local_searches;
    done(part.from + part.size * double(fitted) / double(most));
    auto fit = tried(base, c, held + kPartOfNeeded * needed.local);
    if (!fit) continue;
    ++fitted;
    found.push_back(std::move(*fit));
  }
  for (Fit& fit : base.is_local() ? with_the_best_place(model_, std::move(found)) : found) {
    if (!pays(model_, base, fit, needed) || mends_the_place(base, fit)) {
      keep_doubtful(base, needed, std::move(fit));
      continue;
    }
    fits_.push_back(fit);
    paying.push_back(std::move(fit));
  }
}

// Whether what `fit` adds to a place or a moment paid only because that was found better with it: without it, from
// there, it no longer does.
bool ForwardSearch::mends_the_place(const Fit& base, const Fit& fit) {
  if (!base.is_local()) return false;
  Fit alone = model_.without(fit, fit.hypotheses.size() - 1);
  if (alone.log_evidence <= base.log_evidence) return false;
  alone.size = base.size;
  alone.seen = base.seen;
  const bool mends = !pays(model_, alone, fit, addition_needed(model_, alone, none_, thresholds_));
  fits_.push_back(std::move(alone));
  return mends;
}

Found search(const Model& model, const Screen& screen, const Thresholds& thresholds, const ProgressCallback& progress) {
  return ForwardSearch(model, screen, thresholds, progress).run();
}

}  // namespace umbsim::gap
