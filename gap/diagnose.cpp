#include "gap/diagnose.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/probability.h"
#include "gap/answer/answer_set.h"
#include "gap/answer/closure.h"
#include "gap/answer/effective_twin.h"
#include "gap/answer/explanation.h"
#include "gap/answer/ranking.h"
#include "gap/answer/where.h"
#include "gap/evidence/track_misfit.h"

namespace umbsim::gap {
namespace {

// How much is explained, and of what.
void measure(const Context& w, const LeftUnexplained& left, const Fit& best, Diagnosis& d) {
  const double explained = w.explained_by(best);
  const double before_m2 = mean_square_error_m2(w.model, w.none.predicted.tracks);
  d.before_mm = 1000 * std::sqrt(before_m2);
  for (Cause& c : d.causes) {
    if (!c.fit.hypotheses.empty())
      c.squared_error_drop = 1 - mean_square_error_m2(w.model, c.fit.predicted.tracks) / before_m2;
  }
  d.overdispersion = std::max(1.0, best.residual / w.model.rows());
  d.explainable_fraction = explained / std::max(1e-9, explained + std::max(0.0, left.all()));
  d.noise = w.model.noise();
  d.noise_floor_mm = 1000 * w.model.noise_floor_m();
}

// Differences of engines may be all that a cause leaves. They excuse what is left only where the cause takes more off
// held-out runs than it leaves there.
bool excused(const Model& model, const Fit& fit, const Closure& closure) {
  return !model.another_engines(fit) || closure.takes_more_than_it_leaves();
}

}  // namespace

Diagnosis diagnose(const Model& model, const std::set<std::string>& excluded, const Thresholds& t,
                   const ProgressCallback& progress) {
  Diagnosis d;
  progress("signatures of the effects", 0);
  const Screen screen(model, excluded);
  Found found = search(model, screen, t, progress);
  const Fit none = found.fits.front();
  const LeftUnexplained left_by_none = left_unexplained(model, none, t);
  d.causes = ranked(worth_their_cost(model, std::move(found.fits), left_by_none, t), t);
  progress("held-out runs", 0);
  prefer_what_predicts(model, d.causes, t);
  prefer_kinematic(d.causes);
  progress("what no effect explains", 0);
  const Model little = model.with_little_differences();
  const double none_log_evidence = std::min(none.log_evidence, little.none().log_evidence);
  Context context{model, &model, screen, excluded, t, none, left_by_none, none_log_evidence};
  detect(context, d);
  Fit best = d.causes.front().fit;
  if (d.detected) {
    d.closure = held_out_closure(model, best);
    d.in_poses = !hidden_in_noise(context, best, d.closure);
    if (d.in_poses && !excused(model, best, d.closure)) context.judge = &little;
  }
  const LeftUnexplained left = left_beside(*context.judge, best, t);
  d.unexplained = d.detected && left.all() > t.detect;
  d.unexplained_p = chi_squared_tail(2 * std::max(0.0, left.all()), 2);
  if (d.detected) explain(context, left, best, d);
  d.elsewhere = !model.same_engine(best);
  give_probabilities(d.causes, d.elsewhere);
  measure(context, left, best, d);
  fill_set(context, found, left, best, d);
  say_where(model, none, best, d);
  d.simulated_s = model.simulated_s();
  d.effective = effective_twin(model, screen, excluded, none, d.twin, d.closure);
  return d;
}

}  // namespace umbsim::gap
