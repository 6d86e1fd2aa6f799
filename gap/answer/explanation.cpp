#include "gap/answer/explanation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/probability.h"
#include "effects/words.h"
#include "gap/answer/closure.h"
#include "gap/answer/not_fitted.h"
#include "gap/answer/twin.h"
#include "gap/answer/where.h"
#include "gap/evidence/track_misfit.h"
#include "gap/evidence/uneven_floor.h"

namespace umbsim::gap {
namespace {

constexpr double kAhead = 1;    // log evidence of what is named for what it foretells
constexpr double kSure = 2.94;  // log odds of 95 %

std::vector<std::string> names_of(const Fit& fit) {
  std::vector<std::string> names;
  for (const Hypothesis& f : fit.hypotheses) names.push_back(f.effect);
  return names;
}

void put_none_first(const Thresholds& t, Diagnosis& d) {
  const auto at = std::find_if(d.causes.begin(), d.causes.end(), [](const Cause& c) { return c.name == "none"; });
  std::rotate(d.causes.begin(), at, at + 1);
  double& score = d.causes.front().score;
  score = std::max(score, d.causes.size() > 1 ? d.causes[1].score + t.effect_cost : 0);
}

// What is named in place of unknown, ahead of what the search found best.
void put_first(const Fit& fit, double leftover, Diagnosis& d) {
  const double score = d.causes.front().score + 0.5 * leftover;
  const auto same = [&](const Cause& c) { return c.name == fit.name(); };
  d.causes.erase(std::remove_if(d.causes.begin(), d.causes.end(), same), d.causes.end());
  d.causes.insert(d.causes.begin(), Cause{fit.name(), fit, score, 0});
}

// What is beside an uneven floor takes off held-out runs what noise makes, and a place, which may be part of the floor,
// as much as is left.
Fit beside_uneven_floor(const Context& w, Fit fit, Closure& closure) {
  for (std::size_t i = 0; i < fit.hypotheses.size();) {
    const bool place = fit.hypotheses[i].search_cost > 0;
    const double least_mm = place ? std::max(closure.floor_mm, closure.after_mm) : closure.floor_mm;
    if (closure.known ? closure.worth[i].mm >= least_mm : !place) {
      ++i;
      continue;
    }
    fit = w.model.without(fit, i);
    closure = held_out_closure(w.model, fit);
    i = 0;
  }
  return fit;
}

// An effect that is found, but not fitted, in place of what would be unknown. Whether there is one.
bool named_without_fit(const Context& w, const LeftUnexplained& left, Fit& best, Diagnosis& d) {
  if (w.may_name(kUnevenFloor)) {
    Closure closure = d.closure;
    const bool enough = takes_enough(w.model, best, closure);
    const Fit beside = enough ? beside_uneven_floor(w, best, closure) : w.none;
    if (const auto uneven = with_uneven_floor(w.model, w.none, beside, left.lack, w.thresholds)) {
      if (uneven->hypotheses.size() == 1) add_nothing(closure);
      d.closure = closure;
      best = *uneven;
      put_first(best, left.all(), d);
      d.not_fitted = true;
      d.limits.push_back("an uneven floor's shape is not fitted: the twin has no such floor");
      return true;
    }
  }
  const auto shown = shown_commanded_motion(w.model, d.causes, w.none, w.left_by_none.steady(), w.thresholds);
  if (!shown) return false;
  add_nothing(d.closure);
  best = *shown;
  put_first(best, left.all(), d);
  d.not_fitted = true;
  d.limits.push_back("commands show the demand; how the tyres slip under it is not reproduced");
  return true;
}

// "unknown" among the causes: ahead of them, or behind.
void add_unknown(const Context& w, const Fit& best, bool leads, double leftover, Diagnosis& d) {
  Cause cause{"unknown", best, 0, 0};
  cause.fit.hypotheses.clear();
  const Thresholds& t = w.thresholds;
  cause.score = leads ? d.causes.front().score + 0.5 * leftover
                      : std::min(w.left_by_none.steady() - 2 * t.effect_cost, d.causes.front().score - t.detect);
  d.causes.push_back(std::move(cause));
  std::stable_sort(d.causes.begin(), d.causes.end(), [](const Cause& a, const Cause& b) { return a.score > b.score; });
}

// What foretells held-out runs is in the twin, whatever remains.
void make_twin(const Context& w, bool unknown, Diagnosis& d) {
  Fit twin = d.explanation;
  keep_what_foretells(w.model, twin, d.closure);
  const bool misleads = d.closure.known && d.closure.fraction < 0;
  if (!misleads && !(unknown && (!d.closure.known || d.closure.fraction == 0))) d.twin = std::move(twin);
  if (d.twin_is_nominal()) add_nothing(d.closure);
  if (misleads && !unknown)
    d.limits.push_back("what was found foretells the other runs badly: the twin goes without it");
  else if (!d.twin_is_nominal() && d.twin.hypotheses.size() < d.explanation.hypotheses.size())
    d.limits.push_back(
        fmt::format("the twin holds {} alone: the rest foretells held-out runs no better", d.twin.name()));
}

// Whether only what mends contacts is in the explanation and not in the twin.
bool twin_lacks_mends_alone(const Model& model, const Diagnosis& d) {
  const auto in_twin = [&](const std::string& effect) {
    return std::any_of(d.twin.hypotheses.begin(), d.twin.hypotheses.end(),
                       [&](const Hypothesis& h) { return h.effect == effect; });
  };
  return std::all_of(d.explanation.hypotheses.begin(), d.explanation.hypotheses.end(), [&](const Hypothesis& h) {
    return in_twin(h.effect) || !is_kinematic(h.effect) || mends_contacts(model, d.explanation, h.effect);
  });
}

// Whether counts are missed by clearly more than with `richer`, which another engine's contacts do not make.
bool counts_lose(const Context& w, const Fit& fit, const Fit& richer) {
  const double counts = w.model.counts_misfit(richer);
  return w.model.counts_misfit(fit) > counts + 2 * w.thresholds.addition;
}

// Whether `fit` leaves something that engines do not differ by, most of which is explained where `left` stays.
bool leaves_more_than_engines_do(const Context& w, const Fit& fit, const LeftUnexplained& left) {
  const LeftUnexplained beside = fit.hypotheses.empty() ? w.left_by_none : left_beside(*w.judge, fit, w.thresholds);
  return beside.beyond_engines(w.thresholds) && left.in_tracks < beside.in_tracks / 2;
}

// On another engine's recordings a contact's effect, or a dimension, beside others that takes too little away on
// held-out runs, does not show in counts, and without which nothing is left that engines do not do, is no cause: it
// mends how the two engines' contacts differ. The combination with it stays behind, as not told apart.
void name_what_foretells(const Context& w, const LeftUnexplained& left, Fit& best, Diagnosis& d) {
  if (d.not_fitted || d.twin_is_nominal() || d.twin.hypotheses.size() == d.explanation.hypotheses.size()) return;
  if (w.model.same_engine(best) || !twin_lacks_mends_alone(w.model, d)) return;
  if (counts_lose(w, d.twin, d.explanation) || leaves_more_than_engines_do(w, d.twin, left)) return;
  best = d.explanation = d.twin;
  put_first(best, 2 * kAhead, d);
}

// What is ordinary is needed in the twin beside what brings it to light, such as the grip of a floor on which a robot
// was driven too hard. It is no cause.
void leave_the_ordinary_out(const Context& w, Fit& best, Diagnosis& d) {
  Eigen::Index at = 0;
  for (std::size_t i = 0; i < best.hypotheses.size() && best.hypotheses.size() > 1; ++i) {
    const Hypothesis& h = best.hypotheses[i];
    const Effect effect = effects_of(h, best.p.segment(at, Eigen::Index(h.parameters.size()))).front();
    at += Eigen::Index(h.parameters.size());
    const double number = effect.values.numbers.front();
    if (number <= traits_of(h.effect).ordinary_above) continue;
    d.limits.push_back(fmt::format(
        "{}: {} is nothing out of the ordinary, so it is no cause; the twin has it if it foretells held-out runs",
        words_of(*effect.info).noun,
        shown(*effect.info, {effect.info->parameters.front().name, number, number, number})));
    best = d.explanation = w.model.without(best, i);
    put_first(best, 2 * kAhead, d);
    return;
  }
}

// The fit of what counts show, or else of what rolls, and, if there is a gap to close, of what the world does at a
// place or along a direction, or a toed wheel to one side: engines differ wherever wheels touch the floor, all round,
// and in all runs alike.
Fit without_contacts(const Context& w, Fit fit, const Closure& closure) {
  const auto counted = [](const Hypothesis& h) { return shows_in_counts(h); };
  const bool any_counted = std::any_of(fit.hypotheses.begin(), fit.hypotheses.end(), counted);
  for (std::size_t i = 0; i < fit.hypotheses.size();) {
    const Hypothesis& h = fit.hypotheses[i];
    const bool scrubs = is(h.effect, kScrubs);
    const bool in_all_runs = h.values(start_of(h)).run.empty();
    const bool may_be_engines = in_all_runs && (is_contact(h.effect) || scrubs || (any_counted && !counted(h)));
    const bool stays = !may_be_engines || (closure.known && (scrubs || is_of_the_world(h.effect)));
    Fit less = stays ? fit : w.model.without(fit, i);
    if (stays || counts_lose(w, less, fit))
      ++i;
    else
      fit = std::move(less);
  }
  return fit;
}

// What a fit gains in counts and command features alone, its costs taken off.
double shown_by_counts(const Context& w, const Fit& fit) {
  return (w.model.counts_misfit(w.none) - w.model.counts_misfit(fit)) / 2 -
         w.thresholds.effect_cost * double(fit.hypotheses.size());
}

// Whether counts alone show a fit. How engines' contacts differ moves none, and how their servos do is among the
// nuisances; how servos give way under what contacts do is not known as well.
bool counts_suffice(const Context& w, const Fit& fit) {
  return shown_by_counts(w, fit) > (fit.is_kinematic() ? kSure : w.thresholds.detect);
}

// Whether effects are detected beside no effect.
bool found_alone(const Context& w, const Fit& fit) {
  const Thresholds& t = w.thresholds;
  const double score = fit.log_evidence - w.none.log_evidence - t.effect_cost * double(fit.hypotheses.size());
  return score > t.detect || counts_suffice(w, fit);
}

// What is named where no track strays by more than noise makes it: what stays of the likeliest cause without contacts,
// if it is detected without them, or all of it where contacts explain what engines do not. Where counts speak they
// alone decide between causes: how contacts differ moves no counts.
Fit beside_noise(const Context& w, const LeftUnexplained& left, const Diagnosis& d) {
  const Fit& likeliest = d.causes.front().fit;
  Fit named = without_contacts(w, likeliest, d.closure);
  if (!found_alone(w, named)) named = w.none;
  const bool rolls = !std::any_of(named.hypotheses.begin(), named.hypotheses.end(),
                                  [](const Hypothesis& h) { return shows_in_counts(h); });
  if (rolls && leaves_more_than_engines_do(w, named, left)) return likeliest;
  if (rolls && !named.hypotheses.empty()) return named;
  for (const Cause& c : d.causes) {
    if (shown_by_counts(w, c.fit) <= shown_by_counts(w, named)) continue;
    Fit less = without_contacts(w, c.fit, d.closure);
    if (counts_suffice(w, less) && shown_by_counts(w, less) > shown_by_counts(w, named)) named = std::move(less);
  }
  return named;
}

// Leaves what contacts do within the noise of another engine's recordings out. Whether anything stays.
bool name_beside_noise(const Context& w, const LeftUnexplained& left, Fit& best, Diagnosis& d) {
  const std::string likeliest = std::exchange(best, beside_noise(w, left, d)).name();
  if (best.hypotheses.empty() || best.name() != likeliest)
    d.limits.push_back(
        "no track strays by more than noise makes it: how engines' contacts differ is not told from an effect");
  if (best.hypotheses.empty()) {
    d.detected = d.unexplained = false;
    d.p_value = 1;
    put_none_first(w.thresholds, d);
    return false;
  }
  if (best.name() != likeliest) {
    std::erase_if(d.causes, [&](const Cause& c) { return c.name != "none" && counts_lose(w, c.fit, best); });
    put_first(best, 2 * kAhead, d);
    d.closure = held_out_closure(w.model, best);
  }
  return true;
}

}  // namespace

void detect(const Context& w, Diagnosis& d) {
  const Cause& front = d.causes.front();
  const double named = front.name == "none" ? 0 : front.score;
  const double not_named = w.left_by_none.all();
  const Thresholds& t = w.thresholds;
  const double enough = w.model.same_engine(front.fit) ? enough_to_detect(names_of(front.fit), t) : t.detect;
  d.detected = not_named > t.detect || named > enough || (named > kSure && counts_suffice(w, front.fit));
  d.p_value = chi_squared_tail(2 * std::max({0.0, named, not_named}), 2);
  if (!d.detected) put_none_first(t, d);
}

bool hidden_in_noise(const Context& w, const Fit& fit, const Closure& closure) {
  const bool another = w.model.another_engines(fit);
  const double before_mm = in_sample_error_mm(w.model, w.none), after_mm = in_sample_error_mm(w.model, fit);
  // What brings the robot no nearer may well stand for how contacts differ: it does not say whose engine it was.
  const bool says_whose = after_mm < before_mm || w.model.same_engine(w.none);
  if (says_whose && w.model.same_engine(fit)) return false;
  // Nor does a contact's effect that makes another engine's runs look like those of any robot.
  if (before_mm > most_hidden_mm(w.model, another || w.model.another_engines(w.none))) return false;
  // Where no run could be held out: noise is not explained by more than half.
  if (!another && closure.before_mm == 0 && after_mm < before_mm / 2) return false;
  // What comes again wherever runs pass the same places is the floor's.
  if (!w.may_name(kUnevenFloor)) return true;
  return !may_be_uneven_floor(w.model, w.none) && !find_uneven_floor(w.model, w.none);
}

void explain(const Context& w, const LeftUnexplained& left, Fit& best, Diagnosis& d) {
  if (!d.in_poses && !name_beside_noise(w, left, best, d)) return;
  const bool unknown =
      d.in_poses && !worth_more_than_rest(w.model, best, d.closure) &&
      is_unknown(left, w.left_by_none, w.explained_by(best), w.model.contacts_differ(best), w.thresholds) &&
      !named_without_fit(w, left, best, d);
  add_unknown(w, best, unknown, left.all(), d);
  d.left_over = describe_left_over(w.model, best);
  d.explanation = best;
  make_twin(w, unknown, d);
  if (!unknown) {
    name_what_foretells(w, left, best, d);
    leave_the_ordinary_out(w, best, d);
  }
  d.remainder = remainder_of(w.model, w.screen, w.none, d, left.all());
}

}  // namespace umbsim::gap
