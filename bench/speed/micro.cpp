// One square or one cable crossing at a time, over the length of the step: microseconds per step, simulated seconds per
// second, and the error of that step. Times are of the thread on a processor, the best of all repeats.
#include <benchmark/benchmark.h>

#include <map>
#include <utility>

#include "bench/speed/cases.h"

namespace {

using namespace umbsim;
using namespace umbsim::bench;

constexpr double kMicro = 1e-6;

Outcome drive_once(const Case& c, const RobotModel& robot, double step_s, double fine_step_s) {
  return drive(c, *make_ours(setup(c, robot, step_s, fine_step_s)), robot);
}

// The same driven with steps a tenth as long, once for each case and step.
const Outcome& ten_times_finer(const Case& c, const RobotModel& robot, double step_s, double fine_step_s) {
  static std::map<std::pair<const Case*, std::pair<double, double>>, Outcome> known;
  const auto key = std::make_pair(&c, std::make_pair(step_s, fine_step_s));
  const auto found = known.find(key);
  if (found != known.end()) return found->second;
  return known[key] = drive_once(c, robot, step_s / 10, fine_step_s / 10);
}

// Of the return error: what changes with a ten times smaller step is what this step gets wrong.
void count_square(benchmark::State& state, const Outcome& out, const Outcome& finer) {
  const double dx_m = out.return_error.x_m - finer.return_error.x_m;
  const double dy_m = out.return_error.y_m - finer.return_error.y_m;
  state.counters["return_error_mm"] = 1e3 * out.error;
  state.counters["error_to_finer_mm"] = 1e3 * std::hypot(dx_m, dy_m);
  state.counters["error_to_finer_deg"] = degrees(std::abs(out.heading_error_rad - finer.heading_error_rad));
}

void count_cable(benchmark::State& state, const Outcome& out, const Outcome& finer) {
  state.counters["ratio_to_closed_form"] = out.error;
  state.counters["error_to_finer_deg"] = degrees(std::abs(out.heading_error_rad - finer.heading_error_rad));
}

void time_case(benchmark::State& state, const Case& c) {
  const RobotModel robot = load_robot(c.robot_urdf);
  const double step_s = kMicro * double(state.range(0)), fine_step_s = kMicro * double(state.range(1));
  Outcome best;
  for (auto _ : state) {
    const Outcome out = drive_once(c, robot, step_s, fine_step_s);
    state.SetIterationTime(out.cpu_s);
    if (best.cpu_s == 0 || out.cpu_s < best.cpu_s) best = out;
  }
  state.counters["us_per_step"] = best.us_per_step();
  state.counters["sim_s_per_s"] = best.speed();
  const Outcome& finer = ten_times_finer(c, robot, step_s, fine_step_s);
  c.floor == Case::Floor::cable ? count_cable(state, best, finer) : count_square(state, best, finer);
}

[[maybe_unused]] const bool registered = [] {
  for (const Case& c : kCases) {
    auto* b = benchmark::RegisterBenchmark(c.name, [&c](benchmark::State& state) { time_case(state, c); });
    b->UseManualTime()->Unit(benchmark::kMillisecond)->MinTime(1)->ArgNames({"step_us", "fine_step_us"});
    if (c.floor == Case::Floor::cable) {
      for (const int fine_us : {200, 500, 1000, 2000}) b->Args({fine_us, fine_us});
      b->Args({20000, 1000});  // as shipped
    } else {
      for (const int us : {1000, 2000, 5000, 10000, 20000}) b->Args({us, us});
    }
  }
  return true;
}();

}  // namespace
