#include "gap/answer/twin.h"

#include <algorithm>
#include <cmath>

#include "gap/answer/closure.h"
#include "gap/evidence/track_misfit.h"

namespace umbsim::gap {

namespace {

double worth_mm2(const Closure& closure, std::size_t hypothesis) {
  const double mm = closure.worth[hypothesis].mm;
  return mm * (2 * closure.after_mm + mm);
}

bool may_mend(const std::string& effect) { return is_contact(effect) || is_dimension(effect); }

// By how many mm^2 an effect that may mend another engine's contacts must bring held-out runs nearer: what noise makes,
// and, if it acts everywhere as contacts do, as much as nothing explains.
double least_of_a_mend_mm2(const Hypothesis& h, const Closure& closure) {
  const double least_mm = h.search_cost > 0 ? closure.floor_mm : std::max(closure.floor_mm, closure.after_mm);
  return least_mm * least_mm;
}

// What an explanation leaves may be an error of a tracker's whose frame and clock are free, or what contacts do in
// another engine. Beside the tracker a place or a moment mends a part of any misfit: what it takes away is not counted.
bool all_worth_more_than_rest(const Model& model, const Fit& fit, const Closure& closure) {
  if (!closure.known || model.same_engine(fit)) return false;
  const bool within_noise = closure.after_mm <= closure.most_noise_mm;
  double worth_mm = closure.together().mm;
  if (!model.tracker_is_free()) return within_noise && worth_mm > closure.after_mm;
  for (std::size_t i = 0; i < fit.hypotheses.size(); ++i) {
    if (fit.hypotheses[i].search_cost > 0) worth_mm -= std::max(0.0, closure.worth[i].mm);
  }
  return worth_mm > closure.after_mm || (within_noise && !fit.is_local());
}

}  // namespace

bool mends_contacts(const Model& model, const Fit& fit, const std::string& effect) {
  return model.another_engines(fit) && may_mend(effect);
}

void add_nothing(Closure& closure) {
  closure.fraction = closure.ci95[0] = closure.ci95[1] = 0;
  closure.after_mm = closure.before_mm;
  closure.after_deg = closure.before_deg;
  closure.worth.clear();
}

bool takes_enough(const Model& model, const Fit& fit, const Closure& closure) {
  if (model.same_engine(fit) || !closure.known) return true;
  for (std::size_t i = 0; i < closure.worth.size(); ++i) {
    const Hypothesis& h = fit.hypotheses[i];
    if (may_mend(h.effect) && worth_mm2(closure, i) < least_of_a_mend_mm2(h, closure)) return false;
  }
  return true;
}

void keep_what_foretells(const Model& model, Fit& twin, Closure& closure) {
  while (closure.known && closure.worth.size() > 1) {
    // How far each is from what it must bring.
    const auto least_mm2 = [&](std::size_t i) {
      const Hypothesis& h = twin.hypotheses[i];
      return mends_contacts(model, twin, h.effect) ? least_of_a_mend_mm2(h, closure) : 0;
    };
    std::vector<double> lacks;
    for (std::size_t i = 0; i < closure.worth.size(); ++i) lacks.push_back(least_mm2(i) - worth_mm2(closure, i));
    const auto most = std::max_element(lacks.begin(), lacks.end());
    if (*most <= 0) return;
    const std::size_t out = std::size_t(most - lacks.begin());
    const Fit fewer = model.without(twin, out);
    const Closure with_fewer = held_out_closure(model, fewer);
    const double lost_mm2 = with_fewer.after_mm * with_fewer.after_mm - closure.after_mm * closure.after_mm;
    if (lost_mm2 >= least_mm2(out)) return;
    twin = fewer;
    if (with_fewer.known)
      closure = with_fewer;
    else
      add_nothing(closure);
  }
}

bool worth_more_than_rest(const Model& model, Fit fit, Closure closure) {
  if (all_worth_more_than_rest(model, fit, closure)) return true;
  keep_what_foretells(model, fit, closure);
  return all_worth_more_than_rest(model, fit, closure);
}

Remainder remainder_of(const Model& model, const Screen& screen, const Fit& none, const Diagnosis& d, double leftover) {
  Remainder rest;
  const Fit& twin = d.twin_is_nominal() ? none : d.twin;
  rest.mm = d.closure.known ? d.closure.after_mm : in_sample_error_mm(model, twin);
  const bool gap = d.twin_is_nominal() || d.closure.before_mm > d.closure.most_noise_mm;
  rest.share = d.closure.known ? std::max(0.0, 1 - d.closure.fraction) : gap ? 1 : 0;
  const auto unfitted = [](const Hypothesis& f) { return f.shape_unknown; };
  const auto& hypotheses = d.explanation.hypotheses;
  if (!d.unexplained || std::any_of(hypotheses.begin(), hypotheses.end(), unfitted)) return rest;
  const std::vector<Screen::Candidate> more = screen.on_top_of(d.explanation);
  if (more.empty() || more.front().gain <= 0) return rest;
  rest.pattern = traits_of(more.front().hypothesis.effect).pattern;
  rest.in_catalogue = more.front().gain > 0.5 * leftover;
  return rest;
}

}  // namespace umbsim::gap
