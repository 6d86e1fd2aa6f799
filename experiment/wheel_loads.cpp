#include "experiment/wheel_loads.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace umbsim {
namespace {

constexpr const char* kSide[] = {"left", "right"};
constexpr double kFarOff_rad = 1;
// Less of the time than this does not explain a heading.
constexpr double kHardly = 0.001;

struct OneRun {
  const DrivenRuns* of = nullptr;
  std::size_t index = 0;
  const RunStrain& strain() const { return of->strains[index]; }
  const std::string& id() const { return of->recording.runs[index].id; }
  double heading_rad() const { return of->digests[index].error.theta_rad; }
};

std::vector<OneRun> all_runs(const ExperimentResult& r) {
  std::vector<OneRun> runs;
  const auto add = [&](const DrivenRuns& driven) {
    for (std::size_t i = 0; i < driven.strains.size(); ++i) runs.push_back({&driven, i});
  };
  add(r);
  for (const CalibrationPass& pass : r.passes) add(pass);
  return runs;
}

std::string share(double part_s, double of_s) { return fmt::format("{:.1f} % of the time", 100 * part_s / of_s); }

// Why an odometry is far off: what its wheels did that it does not see.
std::string reasons(const OneRun& run) {
  std::string text;
  const auto add = [&](const std::string& reason) { text += (text.empty() ? "" : ", ") + reason; };
  for (int i = 0; i < 2; ++i) {
    const WheelStrain& s = run.strain().wheel[i];
    const double time_s = run.strain().time_s;
    if (s.unloaded_s > kHardly * time_s)
      add(fmt::format("its {} wheel carried no load for {}", kSide[i], share(s.unloaded_s, time_s)));
    if (s.slid_s > kHardly * time_s) add(fmt::format("its {} wheel slid for {}", kSide[i], share(s.slid_s, time_s)));
  }
  return text.empty()
             ? "its wheels were loaded and rolled, so that wheels, wheelbase or encoders are far from what it believes"
             : text;
}

void warn_of_loads(const ExperimentResult& r, std::vector<std::string>& warnings) {
  const auto loads = wheel_loads(r);
  const std::size_t runs = all_runs(r).size();
  for (int i = 0; i < 2; ++i) {
    const WheelLoads& l = loads[std::size_t(i)];
    if (l.unloaded_runs == 0) continue;
    warnings.push_back(
        fmt::format("the {} wheel carried no load in {} of {} runs, for up to {:.2f} s at a time (run {}, from {:.2f} "
                    "s on) and {:.1f} % "
                    "of the time: its encoder counted what it did not roll. A softer or longer robot.suspension keeps "
                    "it on the floor",
                    kSide[i], l.unloaded_runs, runs, l.longest_unloaded_s, l.longest_run, l.longest_from_s,
                    100 * l.unloaded_share));
  }
}

}  // namespace

std::array<WheelLoads, 2> wheel_loads(const ExperimentResult& r) {
  std::array<WheelLoads, 2> loads;
  double time_s = 0;
  bool first = true;
  for (const OneRun& run : all_runs(r)) {
    time_s += run.strain().time_s;
    for (int i = 0; i < 2; ++i) {
      const WheelStrain& s = run.strain().wheel[i];
      WheelLoads& l = loads[std::size_t(i)];
      l.least_n = first ? s.least_n : std::min(l.least_n, s.least_n);
      l.mean_n += s.mean_n * run.strain().time_s;
      l.unloaded_share += s.unloaded_s;
      l.unloaded_runs += s.longest_unloaded_s > kUnloaded_s;
      if (s.longest_unloaded_s <= l.longest_unloaded_s) continue;
      l.longest_unloaded_s = s.longest_unloaded_s;
      l.longest_run = run.id();
      l.longest_from_s = s.longest_from_s;
    }
    first = false;
  }
  for (WheelLoads& l : loads) {
    if (time_s > 0) l.mean_n /= time_s, l.unloaded_share /= time_s;
  }
  return loads;
}

std::vector<std::string> run_warnings(const ExperimentResult& r) {
  std::vector<std::string> warnings;
  warn_of_loads(r, warnings);
  const OneRun* worst = nullptr;
  int far_off = 0;
  const std::vector<OneRun> runs = all_runs(r);
  for (const OneRun& run : runs) {
    if (std::abs(run.heading_rad()) <= kFarOff_rad) continue;
    ++far_off;
    if (!worst || std::abs(run.heading_rad()) > std::abs(worst->heading_rad())) worst = &run;
  }
  if (worst) {
    warnings.push_back(
        fmt::format("in {} of {} runs the odometry's heading is off by more than a radian; worst in {}, by "
                    "{:.0f} degrees: {}",
                    far_off, runs.size(), worst->id(), worst->heading_rad() * 180 / M_PI, reasons(*worst)));
  }
  if (r.cost.solver_fallbacks > 0) {
    warnings.push_back(
        fmt::format("{} of {} time steps were solved to 1e-6 of the largest impulse at best (solver "
                    "fallbacks): lower physics.step_s",
                    r.cost.solver_fallbacks, r.cost.steps));
  }
  return warnings;
}

}  // namespace umbsim
