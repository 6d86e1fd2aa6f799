#include "gap/answer/effective_twin.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "gap/answer/closure.h"
#include "gap/evidence/track_misfit.h"

namespace umbsim::gap {
namespace {

bool holds(const Fit& fit, const std::string& effect) {
  return std::any_of(fit.hypotheses.begin(), fit.hypotheses.end(),
                     [&](const Hypothesis& h) { return h.effect == effect; });
}

Fit with(const Model& model, const Screen& screen, const Fit& fit, const Hypothesis& dimension) {
  std::vector<Hypothesis> hypotheses = fit.hypotheses;
  hypotheses.push_back(dimension);
  Eigen::VectorXd start(fit.p.size() + Eigen::Index(dimension.parameters.size()));
  start << fit.p, start_of(dimension);
  return model.fit(hypotheses, start, 7, {}, screen.near(fit, dimension));
}

// Whether one twin brings held-out runs nearer than another by as much as it leaves, and as noise makes (mean squares).
bool pays(const Closure& from, const Closure& to) {
  const double least_mm = std::max(to.floor_mm, to.after_mm);
  return std::pow(from.after_mm, 2) - std::pow(to.after_mm, 2) >= std::pow(least_mm, 2);
}

// Adds the dimension with which the runs stray least, as long as it pays on those that are held out.
bool add_best_dimension(const Model& model, const Screen& screen, EffectiveTwin& twin) {
  std::optional<Fit> best;
  const auto error_m2 = [&](const Fit& fit) { return mean_square_error_m2(model, fit.predicted.tracks); };
  for (const Hypothesis& h : screen.hypotheses()) {
    if (!is_dimension(h.effect) || holds(twin.fit, h.effect)) continue;
    Fit fit = with(model, screen, twin.fit, h);
    if (!best || error_m2(fit) < error_m2(*best)) best = std::move(fit);
  }
  if (!best) return false;
  const Closure closure = held_out_closure(model, *best);
  if (!closure.known || !pays(twin.closure, closure)) return false;
  twin.dimensions.push_back(best->hypotheses.back().effect);
  twin.fit = std::move(*best);
  twin.closure = closure;
  return true;
}

EffectiveTwin calibrated(const Model& model, const Screen& screen, const Fit& fit, const Closure& closure) {
  EffectiveTwin twin{{}, fit, closure};
  while (twin.closure.after_mm > closure.most_noise_mm && add_best_dimension(model, screen, twin)) {
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

}  // namespace

std::optional<EffectiveTwin> effective_twin(const Model& model, const Screen& screen, const Fit& none, const Fit& twin,
                                            const Closure& closure) {
  if (!closure.known || closure.after_mm <= closure.most_noise_mm) return std::nullopt;
  const bool takes_nothing = twin.hypotheses.empty() || closure.after_mm == closure.before_mm;
  EffectiveTwin best = calibrated(model, screen, takes_nothing ? none : driven_part(model, twin), closure);
  if (!takes_nothing) {
    Closure nothing = closure;
    nothing.after_mm = nothing.before_mm;
    EffectiveTwin alone = calibrated(model, screen, none, nothing);
    if (pays(best.closure, alone.closure)) best = std::move(alone);
  }
  if (best.dimensions.empty()) return std::nullopt;
  return best;
}

}  // namespace umbsim::gap
