// The grid of docs/fidelity.md, chapter 5: every robot, cable and friction with which the wheel can climb, supports
// that sink by a hundredth of the cable, steps of 1 ms. What it costs, and how far the heading is off the closed form.
#include <benchmark/benchmark.h>
#include <time.h>

#include <algorithm>
#include <cmath>

#include "bench/fidelity/contact/cable.h"

namespace {

using namespace umbsim;
using namespace umbsim::fidelity;

double now_s() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

void cable_grid_case(benchmark::State& state) {
  double least = 1, most = 1, simulated_s = 0, best_s = 0;
  for (auto _ : state) {
    simulated_s = 0;
    const double begin_s = now_s();
    for (CableCase c : cable_grid(Grid::full)) {
      if (c.friction < closed_form(c.robot.wheels[0].radius_m, c.height_m).least_friction) continue;
      const double shipped_s = c.options.fine_step_s;
      c = in_rigid_limit(c);
      c.options.fine_step_s = shipped_s;
      c.speed_mps = 1e-3 * double(state.range(0));
      const CableOutcome out = cross(c);
      least = std::min(least, out.crossed ? out.ratio : 0);
      most = std::max(most, out.ratio);
      simulated_s += out.simulated_s;
    }
    const double cpu_s = now_s() - begin_s;
    state.SetIterationTime(cpu_s);
    best_s = best_s == 0 ? cpu_s : std::min(best_s, cpu_s);
  }
  state.counters["least_ratio"] = least;
  state.counters["most_ratio"] = most;
  state.counters["sim_s_per_s"] = simulated_s / best_s;
}

BENCHMARK(cable_grid_case)->Name("cable_grid")->Arg(20)->Arg(50)->ArgName("speed_mmps")->Iterations(3)
    ->UseManualTime()->Unit(benchmark::kMillisecond);

}  // namespace
