#include <algorithm>

#include "sim/world_state.h"

namespace umbsim {
namespace {

constexpr double kSliding = 0.999;  // of the friction limit

}  // namespace

// Whether this contact is a wheel's at its friction limit, less what is to be spared.
bool World::State::wheel_slides(int i, double spare_ns) const {
  const ContactRows& c = problem.contact[i];
  if (contact_support[i] > 1 || c.friction <= 0 || impulses[c.normal] <= 0) return false;
  if (spare_ns == 0 && report.outcome == SolveOutcome::stick) return false;
  const double limit = kSliding * c.friction * impulses[c.normal] - spare_ns;
  return limit < 0 || impulses.segment<2>(c.normal + 1).squaredNorm() > limit * limit;
}

void World::State::note_strain(double step_s) {
  if (time_s < 0) return;
  for (int i = 0; i < problem.contacts; ++i) {
    if (wheel_slides(i)) strain[contact_support[i]].slid_s += step_s;
  }
  for (int i = 0; i < 2; ++i) {
    auto& s = strain[i];
    const double load_n = loads.wheel_n[i];
    s.least_n = std::min(s.least_n, load_n);
    s.sum_ns += load_n * step_s;
    s.since_s = load_n > 0 ? 0 : s.since_s + step_s;
    if (load_n > 0) continue;
    s.unloaded_s += step_s;
    if (s.since_s <= s.longest_s) continue;
    s.longest_s = s.since_s;
    s.longest_from_s = time_s + step_s - s.since_s;
  }
}

bool World::State::slides(double spare_ns) const {
  for (int i = 0; i < problem.contacts; ++i) {
    if (wheel_slides(i, spare_ns)) return true;
  }
  return false;
}

bool World::slides() const { return state_->slides(); }

WheelStrain World::strain(int wheel) const {
  const auto& s = state_->strain[wheel];
  const double time_s = state_->time_s;
  return {s.least_n, time_s > 0 ? s.sum_ns / time_s : s.least_n, s.unloaded_s, s.longest_s, s.longest_from_s, s.slid_s};
}

}  // namespace umbsim
