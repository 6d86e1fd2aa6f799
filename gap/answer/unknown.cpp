#include "gap/answer/unknown.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "gap/evidence/generic.h"
#include "gap/evidence/impulsive_residuals.h"

namespace umbsim::gap {
namespace {

// What the tracks stray beyond noise and nuisances, as log evidence for something else, as long as the noise is known
// from repeated runs.
double lack_of_fit(const Model& model, const Fit& fit, const Thresholds& t) {
  if (!model.replicated()) return 0;
  return std::max(0.0, fit.misfit - (1 + t.noise_error) * model.rows()) / 2;
}

// What counts stray from commands, and from the course's speeds, beyond their scatter, as log evidence. A single
// commanded motion drowns in the scatter of the counts of many runs, so it is also looked at alone.
double counts_left(const Model& model, const Fit& fit) {
  const auto beyond = [](double misfit, double n) { return std::max(0.0, misfit - n - 3 * std::sqrt(2 * n)) / 2; };
  return std::max(
      beyond(model.counts_misfit(fit), model.count_rows()),
      beyond(model.command_features_misfit(fit.predicted), double(std::tuple_size<CommandFeatures>::value)));
}

// An impulse that is left at a place or at a moment, as log evidence beyond what a difference of engines makes.
double sudden_left(const Model& model, const Fit& fit, const Thresholds& t) {
  return std::max(0.0, strongest(find_impulses(model, fit)) - t.sudden);
}

// The same of readings that do not go with the counts. Engines differ in this by much: it says that a cause is not what
// it was taken for, but no gap is found by it.
double late_left(const Model& model, const Fit& fit, const Thresholds& t) {
  return std::max(0.0, late_gain(model, fit) - t.late);
}

// Of what is left and explained together a share of s is left where s / (1 - s) of the explained is.
double beside(double explained, double known, const Thresholds& t) {
  return std::max(t.detect, (1 - known) / known * explained);
}

}  // namespace

double LeftUnexplained::all() const { return std::max({steady(), lack, sudden, late}); }

LeftUnexplained left_unexplained(const Model& model, const Fit& fit, const Thresholds& t) {
  const double generic = generic_gain(model, fit);
  double density = model.held_density(fit) + generic;
  for (const std::size_t r : model.all_runs()) density -= model.filter(r).log_det() / 2;
  return {generic,
          counts_left(model, fit),
          lack_of_fit(model, fit, t),
          sudden_left(model, fit, t),
          fit.hypotheses.empty() ? 0 : late_left(model, fit, t),
          density};
}

double may_be_left(double explained, bool contacts_differ, const Thresholds& t) {
  return beside(explained, contacts_differ ? t.known_share_elsewhere : t.known_share, t);
}

// A cause that is no likelier, beside errors of no particular cause, than these errors alone, is none.
bool is_unknown(const LeftUnexplained& left, const LeftUnexplained& none, double explained, bool contacts_differ,
                const Thresholds& t) {
  const bool needed = left.density > none.density || left.steady() <= t.detect;
  return !needed || left.steady() > may_be_left(explained, contacts_differ, t) ||
         std::max({left.lack, left.sudden, left.late}) > beside(explained, t.known_share_of_shakes, t);
}

double enough_to_detect(const std::vector<std::string>& effects, const Thresholds& t) {
  // A contact's width does what a wheelbase does, and engines differ in turns by no more for the one than for the
  // other.
  const auto same_for_all_engines = [](const std::string& e) {
    return is_kinematic(e) || is_commanded_motion(e) || is(e, kLikeADimension);
  };
  return std::all_of(effects.begin(), effects.end(), same_for_all_engines) ? t.detect_rolling : t.detect;
}

LeftUnexplained left_beside(const Model& model, const Fit& fit, const Thresholds& t) {
  if (fit.hypotheses.empty()) return left_unexplained(model, fit, t);
  const Model unsure = model.unsure_of(fit);
  return left_unexplained(unsure, unsure.held(fit), t);
}

}  // namespace umbsim::gap
