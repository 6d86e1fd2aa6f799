#include "gap/diagnose.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "gap/answer/answer_set.h"
#include "gap/answer/closure.h"
#include "gap/answer/effective_twin.h"
#include "gap/answer/explanation.h"
#include "gap/answer/ranking.h"
#include "gap/answer/where.h"
#include "gap/evidence/evidence.h"
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

// `none_elsewhere`: log evidence of no effect where engines differ by little.
Diagnosis diagnosed(const Model& model, const std::set<std::string>& excluded, const Thresholds& t,
                    const ProgressCallback& progress, double none_elsewhere) {
  Diagnosis d;
  progress("signatures of the effects", 0);
  Screen screen(model, excluded);
  Found found = search(model, screen, t, progress);
  const Fit none = found.fits.front();
  d.causes = ranked(worth_their_cost(model, std::move(found.fits), t), t);
  progress("held-out runs", 0);
  prefer_what_predicts(model, d.causes, t);
  prefer_kinematic(d.causes);
  progress("what no effect explains", 0);
  const Context context{
      model, screen, excluded, t, none, left_unexplained(model, none, t), std::min(none.log_evidence, none_elsewhere)};
  detect(context, d);
  Fit best = d.causes.front().fit;
  const LeftUnexplained left = left_beside(model, best, t);
  d.unexplained = d.detected && left.all() > t.detect;
  d.unexplained_p = chi_squared_tail(2 * std::max(0.0, left.all()), 2);
  if (d.detected) explain(context, left, best, d);
  give_probabilities(d.causes);
  measure(context, left, best, d);
  fill_set(context, found, left, best, d);
  say_where(model, none, best, d);
  d.simulated_s = model.simulated_s();
  return d;
}

// What contacts do beside other effects may mend how engines differ.
bool holds_contacts_beside_others(const Fit& fit) {
  return fit.hypotheses.size() > 1 && std::any_of(fit.hypotheses.begin(), fit.hypotheses.end(),
                                                  [](const Hypothesis& h) { return is_contact(h.effect); });
}

bool is_unknown(const Diagnosis& d) { return d.causes.front().name == "unknown"; }

bool names_what_foretells(const Diagnosis& d) { return !is_unknown(d) && d.closure.takes_more_than_it_leaves(); }

// The answer with what stands in its twin for what the causes leave.
Diagnosis answered(const Model& model, const std::set<std::string>& excluded, Diagnosis d) {
  if (d.closure.known && d.closure.after_mm > d.closure.most_noise_mm)
    d.effective = effective_twin(model, Screen(model, excluded), model.none(), d.twin, d.closure);
  return d;
}

// Nothing, or what counts show.
bool names_no_pose(const Diagnosis& d) {
  return !d.detected || std::all_of(d.explanation.hypotheses.begin(), d.explanation.hypotheses.end(),
                                    [](const Hypothesis& h) { return shows_in_counts(h); });
}

}  // namespace

// Differences of engines may be all that is there, and they take what mends them from beside a cause. They are no
// excuse for what a cause leaves, but where it takes more off held-out runs; nor do they hide what does.
Diagnosis diagnose(Model& model, const std::set<std::string>& excluded, const Thresholds& t,
                   const ProgressCallback& progress) {
  const Fit none = model.none();
  Diagnosis first = diagnosed(model, excluded, t, progress, none.log_evidence);
  const Cause& cause = first.causes.front();
  const bool doubtful = model.surely_another_engines(none) && !model.same_engine(cause.fit);
  const bool another_engines =
      model.surely_another_engines(cause.fit) ||
      (doubtful && (holds_contacts_beside_others(cause.fit) || !first.closure.takes_more_than_it_leaves()));
  if (!another_engines) return answered(model, excluded, std::move(first));
  Model another = model;
  another.take_for_another_engines();
  const ProgressCallback progress_again = [&](const std::string& stage, double share) {
    progress("for another engine: " + stage, share);
  };
  Diagnosis again = diagnosed(another, excluded, t, progress_again, none.log_evidence);
  const bool hidden = names_no_pose(again) && again.before_mm <= most_hidden_mm(another);
  const bool excused = hidden || names_what_foretells(again);
  if (first.not_fitted || (is_unknown(first) && !excused) || (is_unknown(again) && names_what_foretells(first))) {
    first.simulated_s = again.simulated_s;
    return answered(model, excluded, std::move(first));
  }
  model = std::move(another);
  return answered(model, excluded, std::move(again));
}

}  // namespace umbsim::gap
