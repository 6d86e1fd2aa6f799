// Which places and moments a screen offers.
#include <algorithm>
#include <cmath>

#include "gap/evidence/impulsive_residuals.h"
#include "gap/hypotheses/local_starts.h"
#include "gap/search/search.h"

namespace umbsim::gap {
namespace {

constexpr double kLeastImpulse = 10;  // log evidence below which a place or a moment would not pay

// The leg that a moment belongs to, and the seconds since its start; before the first leg: leg 0.
std::pair<int, double> leg_at(const std::vector<Stretch>& stretches, double time_s) {
  std::pair<int, double> leg{0, 0};
  for (const Stretch& s : stretches) {
    if (s.kind == Stretch::Kind::leg && s.start_s <= time_s) leg = {s.leg, time_s - s.start_s};
  }
  return leg;
}

}  // namespace

// Places and moments where something happened that `fit` leaves.
void Screen::offer_local(const Fit& fit, std::vector<Candidate>& candidates) const {
  const Impulses impulses = find_impulses(model_, fit);
  const double R = model_.recording().robot.wheel_radius_m;
  // Two local events at once are not looked for: the second would mend the first one's shape.
  if (fit.is_local()) return;
  const auto offer = [&](Hypothesis hypothesis, const Starts& starts, const std::vector<double>& reach,
                         int local_searches, double gain, const std::vector<std::size_t>& shown_by = {}) {
    if (excluded_.count(hypothesis.effect) > 0) return;
    Candidate c;
    c.hypothesis = std::move(hypothesis);
    c.start = starts.front();
    c.starts = starts;
    c.reach = Eigen::Map<const Eigen::VectorXd>(reach.data(), Eigen::Index(reach.size()));
    c.local_searches = local_searches;
    // Where grip is missing the best start says little of the top of its hill.
    c.any_start = is(c.hypothesis.effect, kThreshold);
    c.gain = gain - c.hypothesis.search_cost;
    c.shown_by = shown_by;
    candidates.push_back(std::move(c));
  };
  for (std::size_t i = 0; i < std::min<std::size_t>(impulses.places.size(), 2); ++i) {
    const PlaceImpulse& k = impulses.places[i];
    if (k.gain < kLeastImpulse) break;
    if (k.lost_m > 0) {
      offer(bump_hypothesis(k.x_m, k.y_m, k.heading_rad), cable_starts(k.lost_m, R), {0.002, 0.02}, 2, k.gain,
            k.shown_by);
    }
    const bool closely = i == 0 && fit.hypotheses.empty();
    offer(lift_hypothesis(k.x_m, k.y_m), lift_starts(closely), {0.005, 0.01, 0.01}, closely ? 5 : 3, k.gain - 1,
          k.shown_by);
    const double grips = model_.slips_at() > 0 ? model_.slips_at() : 0.05;
    offer(patch_hypothesis(k.x_m, k.y_m), patch_starts(grips, closely), {0.02 * grips, 0.04, 0.04, 0.04},
          closely ? 3 : 1, k.gain - 2, k.shown_by);
  }
  if (impulses.moments.empty() || impulses.moments.front().gain < kLeastImpulse) return;
  const Impulse& k = impulses.moments.front();
  const RecordedRun& run = model_.recording().runs[k.run];
  const auto [leg, seconds] = leg_at(model_.stretches(k.run), run.truth[k.sample].time_s);
  if (leg == 0) return;
  const double kg = model_.mass_kg();
  offer(push_hypothesis(run.id, leg, std::max(0.0, std::round(seconds * 10 - 1) / 10), kg), push_starts(kg),
        {0.05 * kg, 0.05}, 2, k.gain);
}

}  // namespace umbsim::gap
