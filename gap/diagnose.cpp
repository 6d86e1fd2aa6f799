#include "gap/diagnose.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "gap/answer_set.h"
#include "gap/closure.h"
#include "gap/evidence.h"
#include "gap/generic.h"
#include "gap/not_fitted.h"
#include "gap/ranking.h"
#include "gap/search.h"
#include "gap/track_misfit.h"
#include "gap/uneven_floor.h"
#include "gap/where.h"

namespace umbsim::gap {
namespace {

constexpr double kWorthKnowing = 0.05;  // what effects explain, over the misfit that they leave

// What the tracks stray beyond noise and nuisances, as log evidence for something else, as long as the noise is known
// from repeated runs.
double lack_of_fit(const Model& model, const Fit& fit, const Thresholds& t) {
  if (!model.replicated()) return 0;
  return std::max(0.0, fit.misfit - (1 + t.noise_error) * model.rows()) / 2;
}

// What counts stray from commands, and from the course's demand, beyond their scatter, as log evidence. A single demand
// drowns in the scatter of the counts of many runs, so it is also looked at alone.
double counts_left(const Model& model, const Fit& fit) {
  const auto beyond = [](double misfit, double n) { return std::max(0.0, misfit - n - 3 * std::sqrt(2 * n)) / 2; };
  return std::max(beyond(model.counts_misfit(fit.predicted), model.count_rows()),
                  beyond(model.habits_misfit(fit.predicted), double(std::tuple_size<Habits>::value)));
}

// A kick that is left at a place or at a moment, as log evidence beyond what a difference of engines makes.
double sudden_left(const Model& model, const Fit& fit, const Thresholds& t) {
  return std::max(0.0, strongest(find_kicks(model, fit)) - t.sudden);
}

// The same of readings that do not go with the counts. Engines differ in this by much: it says that a cause is not what
// it was taken for, but no gap is found by it.
double late_left(const Model& model, const Fit& fit, const Thresholds& t) {
  return std::max(0.0, late_gain(model, fit) - t.late);
}

// As a share of what is explained. A cable shakes each engine's robot in its own way; where a push, a patch or a hole
// is named the rest of what happened there is its doing, too.
double sudden_that_may_be_left(const Fit& fit, const Thresholds& t) {
  const auto cable = [](const Family& f) { return f.effect == "bump"; };
  const bool shakes = std::any_of(fit.families.begin(), fit.families.end(), cable);
  return fit.is_local() && !shakes ? t.sudden_beside_local : t.sudden_or_late_left;
}

std::vector<std::string> names_of(const Fit& fit) {
  std::vector<std::string> names;
  for (const Family& f : fit.families) names.push_back(f.effect);
  return names;
}

Stage stage_of(const Fit& fit) { return find_effect(fit.families.front().effect).stage; }

void find_place(const Model& model, const Fit& fit, Diagnosis& d) {
  for (const Effect& e : fit.effects()) {
    const std::string pattern = pattern_of(e.info->name);
    if (pattern == "place") {
      for (std::size_t i = 0; i < e.info->parameters.size(); ++i) {
        if (e.info->parameters[i].name == "x_m") {
          d.place_m[0] = e.values.numbers[i];
          d.has_place = true;
        }
        if (e.info->parameters[i].name == "y_m") d.place_m[1] = e.values.numbers[i];
      }
    } else if (pattern == "one_run") {
      for (std::size_t r = 0; r < model.recording().runs.size(); ++r) {
        const RecordedRun& run = model.recording().runs[r];
        if (run.id != e.values.run) continue;
        for (const Stretch& s : model.stretches(r)) {
          if (s.kind != Stretch::Kind::leg || s.leg != int(e.values.numbers[0])) continue;
          for (const TruthSample& sample : run.truth) {
            if (sample.time_s > s.start_s + e.values.numbers[1]) break;
            d.place_m[0] = sample.X_WB.x_m;
            d.place_m[1] = sample.X_WB.y_m;
          }
          d.has_place = true;
        }
      }
    }
  }
}

// The twin is the scenario as it was.
void add_nothing(Closure& closure) {
  closure.fraction = closure.ci95[0] = closure.ci95[1] = 0;
  closure.after_mm = closure.before_mm;
  closure.after_deg = closure.before_deg;
  closure.worth.clear();
}

// Whether an explanation takes more millimetres off held-out runs than it leaves, or all that is beyond noise, and what it
// leaves of the evidence may be an error of its model: of a contact's, which differs from engine to engine, or of a
// tracker's whose frame and clock are free. A place or a moment mends a part of any misfit.
bool worth_more_than_rest(const Model& model, const Fit& fit, const Closure& closure) {
  if (!closure.known || fit.is_local()) return false;
  if (!tracker_is_free(model.recording())) return !fit.only_rolls() && closure.together().mm > closure.after_mm;
  return closure.after_mm <= closure.most_noise_mm || closure.together().mm > closure.after_mm;
}

// Without the effects that foretell held-out runs worse than the others do alone, and the closure of what stays.
void keep_what_foretells(const Model& model, Fit& twin, Closure& closure) {
  while (closure.known && closure.worth.size() > 1) {
    const auto less = [](const Worth& a, const Worth& b) { return a.mm < b.mm; };
    const auto least = std::min_element(closure.worth.begin(), closure.worth.end(), less);
    if (least->mm >= 0) return;
    const Fit fewer = model.without(twin, std::size_t(least - closure.worth.begin()));
    const Closure with_fewer = held_out_closure(model, fewer);
    if (!with_fewer.known || with_fewer.after_mm >= closure.after_mm) return;
    twin = fewer;
    closure = with_fewer;
  }
}

// What the catalogue would make of the rest: `leftover` is the log evidence for errors of no particular cause.
Remainder remainder_of(const Model& model, const Screen& screen, const Fit& none, const Diagnosis& d, double leftover) {
  Remainder rest;
  const Fit& twin = d.twin_is_nominal() ? none : d.twin;
  rest.mm = d.closure.known ? d.closure.after_mm : 1000 * std::sqrt(mean_square_error_m2(model, twin.predicted.tracks));
  rest.share = d.closure.known ? std::max(0.0, 1 - d.closure.fraction) : d.twin_is_nominal() ? 1 : 0;
  const auto unfitted = [](const Family& f) { return f.shape_unknown; };
  const auto& families = d.explanation.families;
  if (!d.unexplained || std::any_of(families.begin(), families.end(), unfitted)) return rest;
  const std::vector<Screen::Candidate> more = screen.on_top_of(d.explanation);
  if (more.empty() || more.front().gain <= 0) return rest;
  rest.pattern = pattern_of(more.front().family.effect);
  rest.in_catalogue = more.front().gain > 0.5 * leftover;
  return rest;
}

// What is named in place of unknown, ahead of what the search found best.
void put_first(const Fit& fit, double leftover, Diagnosis& d) {
  const double score = d.causes.front().score + 0.5 * leftover;
  const auto same = [&](const Cause& c) { return c.name == fit.name(); };
  d.causes.erase(std::remove_if(d.causes.begin(), d.causes.end(), same), d.causes.end());
  d.causes.insert(d.causes.begin(), Cause{fit.name(), fit, score, 0});
}

}  // namespace

double may_be_left(const Fit& fit, double explained, const Thresholds& t) {
  const auto toe = [](const Family& f) { return f.effect == "wheel_misalignment"; };
  const bool toed = std::any_of(fit.families.begin(), fit.families.end(), toe);
  // Of what is left and explained together a share of s is left where s / (1 - s) of the explained is.
  const auto beside = [&](double known_share) { return (1 - known_share) / known_share * std::max(0.0, explained); };
  const double left = beside(toed ? t.known_share_of_toe : t.known_share);
  return fit.only_rolls() ? std::min(left, std::max(t.left_by_rolling, beside(t.known_share_of_rolling))) : left;
}

double enough_to_detect(const std::vector<std::string>& effects, const Thresholds& t) {
  // A contact's width does what a wheelbase does, and engines differ in turns by no more for the one than for the
  // other.
  const auto same_for_all_engines = [](const std::string& e) {
    return only_rolls(e) || is_demand(e) || e == "contact_patch";
  };
  return std::all_of(effects.begin(), effects.end(), same_for_all_engines) ? t.detect_rolling : t.detect;
}

std::vector<Effect> twin_effects(const Fit& fit) {
  std::vector<Effect> effects;
  Eigen::Index at = 0;
  for (const Family& f : fit.families) {
    const Eigen::VectorXd p = fit.p.segment(at, Eigen::Index(f.parameters.size()));
    at += p.size();
    if (f.shape_unknown) continue;
    for (Effect& e : effects_of(f, p)) effects.push_back(std::move(e));
  }
  return effects;
}

Diagnosis diagnose(const Model& model, const std::set<std::string>& excluded, const Thresholds& t, const Say& say) {
  Diagnosis d;
  say("signatures of the effects", 0);
  const Screen screen(model, excluded);
  Found found = search(model, screen, t, say);
  const Fit none = found.fits.front();
  std::vector<Fit> fits = worth_their_cost(model, std::move(found.fits), t);
  d.causes = ranked(fits, t);
  say("held-out runs", 0);
  prefer_what_predicts(model, d.causes, t);
  prefer_what_rolls(d.causes);
  say("what no effect explains", 0);
  const double generic_none = generic_gain(model, none) + counts_left(model, none);
  const double lack_none = lack_of_fit(model, none, t);
  const Cause& front = d.causes.front();
  const double named = front.name == "none" ? 0 : front.score;
  const double not_named = std::max({generic_none, lack_none, sudden_left(model, none, t)});
  const double gap = std::max(named, not_named);
  d.detected = not_named > t.detect || named > enough_to_detect(names_of(front.fit), t);
  d.p_value = chi_squared_tail(2 * std::max(0.0, gap), 2);
  d.noise = model.noise();
  d.noise_floor_mm = 1000 * model.noise_floor_m();
  if (!d.detected) {
    const auto at = std::find_if(d.causes.begin(), d.causes.end(), [](const Cause& c) { return c.name == "none"; });
    std::rotate(d.causes.begin(), at, at + 1);
    d.causes.front().score =
        std::max(d.causes.front().score, d.causes.size() > 1 ? d.causes[1].score + t.effect_cost : 0);
  }
  Fit best = d.causes.front().fit;
  const double lack = lack_of_fit(model, best, t);
  const double left_generic = generic_gain(model, best) + counts_left(model, best);
  const double sudden = sudden_left(model, best, t);
  const double no_steady_error = std::max(sudden, best.families.empty() ? 0 : late_left(model, best, t));
  const double leftover = std::max({left_generic, lack, no_steady_error});
  double explained = best.log_evidence - none.log_evidence;
  d.unexplained = d.detected && leftover > t.detect;
  d.unexplained_p = chi_squared_tail(2 * std::max(0.0, leftover), 2);
  if (d.detected) {
    // An explanation that leaves much, or that foretells nothing of the other conditions, is none.
    d.closure = held_out_closure(model, best);
    const bool much = explained > t.most_left * leftover;
    const bool foretells = !d.closure.known || d.closure.ci95[1] > t.least_closure || much;
    const bool little = left_generic > may_be_left(best, explained, t);
    const bool other_kind = no_steady_error > std::max(t.detect, t.sudden_or_late_left * explained) ||
                            sudden > std::max(t.detect, sudden_that_may_be_left(best, t) * explained);
    bool unknown = !worth_more_than_rest(model, best, d.closure) &&
                   (other_kind || (d.unexplained && (!foretells || little || lack > t.misfit_left * lack_none)));
    if (unknown && excluded.count("uneven_floor") == 0) {
      if (const std::optional<Fit> uneven = with_uneven_floor(model, none, best, lack, t)) {
        if (uneven->families.size() == 1) add_nothing(d.closure);
        best = *uneven;
        unknown = false;
        put_first(best, leftover, d);
        d.limits.push_back("an uneven floor's shape is not fitted: the twin has no such floor");
      }
    }
    if (unknown) {
      if (const std::optional<Fit> demand = plain_demand(model, d.causes, none, generic_none, t)) {
        add_nothing(d.closure);
        best = *demand;
        unknown = false;
        explained = best.log_evidence - none.log_evidence;
        put_first(best, leftover, d);
        d.limits.push_back("commands show the demand; how the tyres slip under it is not reproduced");
      }
    }
    Cause cause{"unknown", best, 0, 0};
    cause.fit.families.clear();
    cause.score = unknown ? d.causes.front().score + 0.5 * leftover : generic_none - 2 * t.effect_cost;
    if (!unknown) cause.score = std::min(cause.score, d.causes.front().score - t.detect);
    d.causes.push_back(std::move(cause));
    std::stable_sort(d.causes.begin(), d.causes.end(),
                     [](const Cause& a, const Cause& b) { return a.score > b.score; });
    d.left_over = describe_left_over(model, best);
    d.explanation = best;
    // What foretells held-out runs is in the twin, whatever remains.
    Fit twin = best;
    keep_what_foretells(model, twin, d.closure);
    const bool misleads = d.closure.known && d.closure.fraction < 0;
    if (!misleads && !(unknown && (!d.closure.known || d.closure.fraction == 0))) d.twin = std::move(twin);
    if (d.twin_is_nominal()) add_nothing(d.closure);
    if (misleads && !unknown)
      d.limits.push_back("what was found foretells the other runs badly: the twin goes without it");
    else if (!d.twin_is_nominal() && d.twin.families.size() < best.families.size())
      d.limits.push_back(
          fmt::format("the twin holds {} alone: the rest foretells held-out runs no better", d.twin.name()));
    d.remainder = remainder_of(model, screen, none, d, leftover);
  }
  give_probabilities(d.causes);
  const double before_m2 = mean_square_error_m2(model, none.predicted.tracks);
  d.before_mm = 1000 * std::sqrt(before_m2);
  for (Cause& c : d.causes) {
    if (!c.fit.families.empty())
      c.squared_error_drop = 1 - mean_square_error_m2(model, c.fit.predicted.tracks) / before_m2;
  }
  d.overdispersion = std::max(1.0, best.residual / model.rows());
  d.explainable_fraction = explained / std::max(1e-9, explained + std::max(0.0, leftover));
  d.set = tied(d.causes, t);
  // What explains more than anything of no particular cause could is worth knowing, even where it is not the whole.
  const bool worth_knowing = !best.families.empty() && explained > std::max(left_generic, kWorthKnowing * lack);
  if (d.causes.front().name == "unknown") {
    if (worth_knowing) add_what_explains(best, none, d);
    add_what_counts_show(model, none, t, d);
    if (excluded.count("uneven_floor") == 0 && may_be_uneven_floor(model, none)) d.set.push_back("uneven_floor");
  }
  add_doubtful(found.doubtful, none, d);
  add_faint(found.p_values, t, d);
  d.segments = segment_scores(model, none);
  if (d.segments.size() > 12) d.segments.resize(12);
  if (d.detected && !best.families.empty()) {
    // The effect that explains most names the stage.
    d.stage = name(stage_of(best));
    d.pattern = pattern_of(best.families.front().effect);
    find_place(model, best, d);
    if (d.has_place) d.place_wheel = wheel_at(model, d.place_m[0], d.place_m[1]);
  }
  d.simulated_s = model.simulated_s();
  return d;
}

}  // namespace umbsim::gap
