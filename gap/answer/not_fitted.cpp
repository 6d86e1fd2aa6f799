#include "gap/answer/not_fitted.h"

#include <algorithm>

#include "gap/evidence/generic.h"
#include "gap/evidence/uneven_floor.h"

namespace umbsim::gap {
namespace {

constexpr double kMostOfCounts = 0.8;  // of what counts miss, for a commanded motion to be the cause
constexpr double kMostSteady = 0.3;    // of what anything could explain, that goes on at constant speed, the same

}  // namespace

std::optional<Fit> with_uneven_floor(const Model& model, const Fit& none, const Fit& best, double lack,
                                     const Thresholds& t) {
  // The same shifts of many passes pretend to be many numbers: an effect beside the floor has to explain a good share.
  const double explained = best.log_evidence - none.log_evidence;
  const bool stays = explained > t.beside_floor * (explained + lack);
  const Fit& beside = stays ? best : none;
  const auto floor = find_uneven_floor(model, beside);
  if (!floor) return {};
  return on_uneven_floor(beside, *floor);
}

std::optional<Fit> shown_commanded_motion(const Model& model, const std::vector<Cause>& causes, const Fit& none,
                                          double generic_none, const Thresholds& t) {
  // What goes wrong at constant speed is not its doing.
  if (steady_gain(model, none) > kMostSteady * generic_none) return {};
  const double before = model.counts_misfit(none);
  std::optional<Fit> found;
  double most = std::max(2 * t.plainly_shown, kMostOfCounts * before);
  for (const Cause& c : causes) {
    const bool commanded = c.fit.hypotheses.size() == 1 && is_commanded_motion(c.fit.hypotheses.front().effect);
    const double shown = commanded ? before - model.counts_misfit(c.fit) : 0;
    if (shown < most) continue;
    found = c.fit;
    most = shown;
  }
  return found;
}

}  // namespace umbsim::gap
