#include <algorithm>

#include "sim/world_state.h"

namespace umbsim {
namespace {

constexpr int kStopRounds = 5;
constexpr double kAtStop_m = 1e-12;

// Of the row's direction along z of the base: how fast its contact opens per speed of the spring.
double upwards(const DofVector& row) { return row[5]; }

}  // namespace

// What is between spring and floor has no mass of its own here: it is carried as a part of the base. So the floor's
// force F along z of the base is the spring's,
//   F = preload + k (up + h v) + d v,   hence a speed v = (F - preload - k up) / (h k + d) of the wheel against the
//   base,
// implicit and stable at any step. In each row of the support's contacts, along t, it adds z_t v: a compliance that
// couples these rows, and an offset. At a stop v is what reaches it.
void World::State::add_springs(double step_s) {
  for (int i = 0; i < problem.contacts; ++i) {
    const Support& s = supports[contact_support[i]];
    if (!s.spring.sprung()) continue;
    const int first = problem.contact[i].normal, size = problem.contact[i].friction > 0 ? 3 : 1;
    const double give = 1 / (step_s * s.spring.stiffness_npm + s.spring.damping_nspm);
    for (int r = first; r < first + size; ++r) {
      problem.b[r] += upwards(row[r]) * spring_speed(s, 0, step_s);
      if (s.stop != 0) continue;
      for (int j = 0; j < problem.contacts; ++j) {
        if (contact_support[j] != contact_support[i]) continue;
        const int other = problem.contact[j].normal, count = problem.contact[j].friction > 0 ? 3 : 1;
        for (int c = other; c < other + count; ++c) {
          problem.A(r, c) += upwards(row[r]) * upwards(row[c]) * give / step_s;
        }
      }
    }
  }
}

double World::State::spring_speed(const Support& s, double force_n, double step_s) const {
  if (!s.spring.sprung()) return 0;
  if (s.stop > 0) return (s.spring.up_m - s.up_m) / step_s;
  if (s.stop < 0) return (-s.spring.down_m - s.up_m) / step_s;
  return (force_n - s.spring.preload_n - s.spring.stiffness_npm * s.up_m) /
         (step_s * s.spring.stiffness_npm + s.spring.damping_nspm);
}

// Speeds that follow from the impulses. True where a spring met a stop, or left one: then these are not the answer yet.
bool World::State::change_stops(double step_s) {
  double force_n[8]{};
  for (int i = 0; i < problem.contacts; ++i) {
    const int first = problem.contact[i].normal, size = problem.contact[i].friction > 0 ? 3 : 1;
    for (int r = first; r < first + size; ++r) force_n[contact_support[i]] += upwards(row[r]) * impulses[r] / step_s;
  }
  return change_stops(step_s, force_n);
}

bool World::State::change_stops(double step_s, const double (&force_n)[8]) {
  bool changed = false;
  for (std::size_t i = 0; i < supports.size(); ++i) {
    Support& s = supports[i];
    if (!s.spring.sprung()) continue;
    const int before = s.stop;
    s.up_mps = spring_speed(s, force_n[i], step_s);
    const double next_m = s.up_m + step_s * s.up_mps;
    const double spring_n = s.spring.preload_n + s.spring.stiffness_npm * next_m + s.spring.damping_nspm * s.up_mps;
    if (before == 0)
      s.stop = (next_m > s.spring.up_m + kAtStop_m) - (next_m < -s.spring.down_m - kAtStop_m);
    else if (before > 0 ? force_n[i] < spring_n : force_n[i] > spring_n)
      s.stop = 0;
    changed = changed || s.stop != before;
  }
  return changed;
}

void World::State::solve_on_springs(double step_s) {
  const RowMatrix A = problem.A;
  const RowVector b = problem.b;
  for (int round = 0; round < kStopRounds; ++round) {
    problem.A = A;
    problem.b = b;
    add_springs(step_s);
    report = solve_contacts(problem, impulses);
    if (!change_stops(step_s)) return;
  }
}

void World::State::move_springs(double step_s) {
  for (Support& s : supports) {
    if (s.spring.sprung()) s.up_m = std::clamp(s.up_m + step_s * s.up_mps, -s.spring.down_m, s.spring.up_m);
  }
}

}  // namespace umbsim
