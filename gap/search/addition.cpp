#include "gap/search/addition.h"

#include <algorithm>
#include <string>
#include <vector>

namespace umbsim::gap {

namespace {

constexpr double kContradicted = 25;   // five standard deviations, squared
constexpr double kMost = 0.5;          // of the misfit
constexpr double kMostOfReading = 16;  // squared standard deviations
constexpr double kPlain = 2.5;         // times what counts must show

std::ptrdiff_t that_look(const Fit& fit, unsigned looks) {
  return std::count_if(fit.hypotheses.begin(), fit.hypotheses.end(),
                       [&](const Hypothesis& f) { return (traits_of(f.effect).looks & looks) != 0; });
}

bool adds_local(const Fit& base, const Fit& fit) {
  return std::any_of(fit.hypotheses.begin(), fit.hypotheses.end(), [&](const Hypothesis& f) {
    const auto same = [&](const Hypothesis& g) { return g.effect == f.effect; };
    return f.search_cost > 0 && std::none_of(base.hypotheses.begin(), base.hypotheses.end(), same);
  });
}

bool adds_dimensions_alone(const Fit& base, const Fit& fit) {
  const auto in_base = [&](const std::string& effect) {
    return std::any_of(base.hypotheses.begin(), base.hypotheses.end(),
                       [&](const Hypothesis& g) { return g.effect == effect; });
  };
  return fit.hypotheses.size() > base.hypotheses.size() &&
         std::all_of(fit.hypotheses.begin(), fit.hypotheses.end(),
                     [&](const Hypothesis& f) { return is_dimension(f.effect) || in_base(f.effect); });
}

// Squares, in standard deviations, that a fit leaves beyond noise. Single readings count up to a bound only: a cable or
// a patch that shakes the robot otherwise than foretold leaves much at one place, which says nothing of the rest.
double excess(const Model& model, const Fit& fit) {
  double sum = 0;
  for (const Eigen::VectorXd& left : model.left_over(fit)) sum += left.cwiseAbs2().cwiseMin(kMostOfReading).sum();
  return std::max(0.0, std::min(sum, fit.misfit) - (1 + Thresholds{}.noise_error) * model.rows());
}

bool holds_all_of(const Fit& fit, const Fit& base) {
  return std::all_of(base.hypotheses.begin(), base.hypotheses.end(), [&](const Hypothesis& g) {
    return std::any_of(fit.hypotheses.begin(), fit.hypotheses.end(),
                       [&](const Hypothesis& f) { return f.effect == g.effect; });
  });
}

// Whether what `fit` adds is more than what the effects of `base` may do otherwise in another engine. An explanation by
// other effects adds nothing to these.
bool stays_beside(const Model& model, const Fit& base, const Fit& fit, const Needed& needed, double extra) {
  if (!holds_all_of(fit, base)) return true;
  if (!needed.beside) {
    needed.beside = std::make_shared<const Model>(model.unsure_of(base));
    needed.base_beside = needed.beside->held_density(base) - model.held_density(base);
  }
  const double beside = needed.beside->held_density(fit) - model.held_density(fit) - needed.base_beside;
  const double gain = fit.log_evidence - base.log_evidence + beside;
  return gain >= extra * Thresholds{}.addition;
}

}  // namespace

bool contradicted(const Model& model, const Fit& base, const Fit& fit) {
  return fit.log_chance < -kContradicted / 2 || model.counts_misfit(fit) > model.counts_misfit(base) + kContradicted;
}

double lookalike_share(const Fit& base, const Fit& fit) {
  double share = 0;
  for (const Hypothesis& f : base.hypotheses) {
    const Traits& errs = traits_of(f.effect);
    if (that_look(fit, errs.error_looks) > that_look(base, errs.error_looks)) share = std::max(share, errs.error_share);
  }
  return share;
}

double seen_between(const Model& model, const Fit& base, const Fit& fit) {
  double square = 0;
  const auto change = model.columns(base.predicted, {fit.predicted}, {1});
  for (std::size_t r = 0; r < change.size(); ++r) {
    square += change[r].topRows(3 * Eigen::Index(model.filter(r).samples())).squaredNorm();
  }
  return square;
}

Needed addition_needed(const Model& model, const Fit& base, const Fit& none, const Thresholds& t) {
  const double gained = std::max(0.0, base.log_evidence - none.log_evidence);
  const double left = excess(model, base);
  const double counts_left = model.counts_misfit(base);
  const double counts_gained = std::max(0.0, model.counts_misfit(none) - counts_left) / 2;
  // Where much is left the noise model is too narrow for what it is asked: evidence in units of what is left.
  const double spread = std::max(1.0, base.misfit / model.rows() - t.noise_error);
  const double own = spread * (t.addition + t.addition_share * gained);
  const double for_misfit = t.misfit_share * left / 2;
  Needed needed;
  needed.gained = gained;
  needed.left = left;
  needed.everywhere = std::max(own, for_misfit);
  needed.local = std::max(own, t.local_misfit_share * left / 2);
  // Counts and command features are measured as they are: no noise of the tracks, and no misfit of theirs, speaks
  // against them.
  needed.counts = std::max(t.addition + t.counts_share * counts_gained, t.counts_misfit_share * counts_left / 2);
  // The screen is linear: beside something large an effect may bring ten times what it sees.
  needed.hint = std::max({0.5 * t.addition, 0.1 * own, 0.5 * for_misfit});
  return needed;
}

bool pays(const Model& model, const Fit& base, const Fit& fit, const Needed& needed, double extra) {
  const double gain = fit.log_evidence - base.log_evidence;
  // Dimensions of a real robot are always a little off: they pay for their numbers, and no more.
  if (model.tracker_is_free() && adds_dimensions_alone(base, fit)) return gain >= extra * Thresholds{}.effect_cost;
  // What leaves most of the misfit as it was mends an error of the model, as any effect could. The model of what rolls
  // and counts has none: there it is noise that is not as it was thought to be.
  // Nor is a radius or a wheelbase such an error: these act alike in every engine.
  const bool mends = !fit.is_kinematic() && !adds_dimensions_alone(base, fit);
  const bool dear = (mends && excess(model, fit) > kMost * needed.left) || adds_local(base, fit);
  if (gain < extra * lookalike_share(base, fit) * needed.gained) return false;
  if (gain >= extra * (dear ? needed.local : needed.everywhere)) return stays_beside(model, base, fit, needed, extra);
  const double counts = (model.counts_misfit(base) - model.counts_misfit(fit)) / 2;
  // What tracks speak for mostly they must pay for, unless most of what counts show is at stake.
  const bool by_counts = counts > gain / 2 || counts >= extra * kPlain * needed.counts;
  return by_counts && std::min(gain, counts) >= extra * needed.counts && stays_beside(model, base, fit, needed, extra);
}

}  // namespace umbsim::gap
