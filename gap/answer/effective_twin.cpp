#include "gap/answer/effective_twin.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "gap/answer/closure.h"
#include "gap/evidence/track_misfit.h"

namespace umbsim::gap {
namespace {

constexpr int kRoundsBeside = 4;  // the causes have been fitted

Fit with(const Model& model, const Fit& fit, const Hypothesis& more, const Eigen::VectorXd& from,
         const Descending& descending = {}, const std::optional<Linearisation>& known = std::nullopt) {
  std::vector<Hypothesis> hypotheses = fit.hypotheses;
  hypotheses.push_back(more);
  Eigen::VectorXd start(fit.p.size() + from.size());
  start << fit.p, from;
  return model.fit(hypotheses, start, descending, {}, known);
}

// Whether runs come nearer by as much as is left, and as noise makes (mean squares).
bool pays(double from_mm, double to_mm, double floor_mm) {
  return std::pow(from_mm, 2) - std::pow(to_mm, 2) >= std::pow(std::max(floor_mm, to_mm), 2);
}

// Adds the first dimension, in the order of what they explain, that pays on the runs, and on those held out.
bool add_dimension(const Model& model, const Screen& screen, EffectiveTwin& twin) {
  std::vector<Screen::Candidate> dimensions =
      screen.by_derivatives(twin.fit, [](const Hypothesis& h) { return is_dimension(h.effect); });
  std::sort(dimensions.begin(), dimensions.end(), [](const auto& a, const auto& b) { return a.gain > b.gain; });
  for (const Screen::Candidate& dimension : dimensions) {
    const Hypothesis& h = dimension.hypothesis;
    Fit fit = with(model, twin.fit, h, start_of(h), {kRoundsBeside}, screen.near(twin.fit, h));
    const double floor_mm = twin.closure.floor_mm;
    if (!pays(in_sample_error_mm(model, twin.fit), in_sample_error_mm(model, fit), floor_mm)) continue;
    const Closure closure = held_out_closure(model, fit);
    if (!closure.known || !pays(twin.closure.after_mm, closure.after_mm, floor_mm)) continue;
    twin.dimensions.push_back(dimension.hypothesis.effect);
    twin.fit = std::move(fit);
    twin.closure = closure;
    return true;
  }
  return false;
}

EffectiveTwin calibrated(const Model& model, const Screen& screen, const Fit& fit, const Closure& closure) {
  EffectiveTwin twin{{}, fit, closure};
  while (twin.closure.after_mm > closure.most_noise_mm && add_dimension(model, screen, twin)) {
  }
  return twin;
}

// What of a twin moves robots: an uneven floor, say, is named and not driven over.
Fit driven_part(const Model& model, Fit twin) {
  for (std::size_t i = 0; i < twin.hypotheses.size();) {
    if (twin.hypotheses[i].shape_unknown)
      twin = model.without(twin, i);
    else
      ++i;
  }
  return twin;
}

EffectiveTwin with_dimensions(const Model& model, const Screen& screen, const Fit& none, const Fit& twin,
                              const Closure& closure) {
  if (closure.after_mm <= closure.most_noise_mm) return {{}, driven_part(model, twin), closure};
  const bool takes_nothing = twin.hypotheses.empty() || closure.after_mm == closure.before_mm;
  EffectiveTwin best = calibrated(model, screen, takes_nothing ? none : driven_part(model, twin), closure);
  if (!takes_nothing) {
    Closure nothing = closure;
    nothing.after_mm = nothing.before_mm;
    EffectiveTwin alone = calibrated(model, screen, none, nothing);
    if (pays(best.closure.after_mm, alone.closure.after_mm, closure.floor_mm)) best = std::move(alone);
  }
  return best;
}

// Neither effect of the scrub is in the twin already, or excluded.
bool may_scrub(const Fit& twin, const std::set<std::string>& excluded) {
  const Hypothesis scrub = scrub_hypothesis();
  const std::vector<Effect> there = twin.effects();
  for (const Effect& e : effects_of(scrub, start_of(scrub))) {
    const auto is_it = [&](const Effect& other) { return other.info == e.info; };
    if (excluded.count(e.info->name) > 0 || std::any_of(there.begin(), there.end(), is_it)) return false;
  }
  return !twin.hypotheses.empty();
}

void add_scrub(const Model& model, EffectiveTwin& twin) {
  const Hypothesis scrub = scrub_hypothesis();
  const Model alike = model.with_turns_alike();
  Fit fit = with(alike, twin.fit, scrub, Eigen::VectorXd::Constant(1, scrub.parameters.front().step));
  const Closure closure = held_out_closure(alike, fit);
  if (!closure.known || closure.after_mm >= twin.closure.after_mm) return;
  twin.dimensions.push_back(scrub.effect);
  twin.fit = std::move(fit);
  twin.closure = closure;
}

}  // namespace

std::optional<EffectiveTwin> effective_twin(const Model& model, const Screen& screen,
                                            const std::set<std::string>& excluded, const Fit& none, const Fit& twin,
                                            const Closure& closure) {
  if (!closure.known) return std::nullopt;
  EffectiveTwin best = with_dimensions(model, screen, none, twin, closure);
  if (model.tracker_is_free() && may_scrub(best.fit, excluded)) add_scrub(model, best);
  if (best.dimensions.empty()) return std::nullopt;
  return best;
}

}  // namespace umbsim::gap
