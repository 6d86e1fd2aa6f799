#include "experiment/run.h"

#include <tbb/global_control.h>

#include <chrono>

#include "experiment/drive/check_loop.h"
#include "experiment/drive_all.h"
#include "experiment/measure.h"
#include "experiment/wheel_loads.h"

namespace umbsim {
namespace {

// Corrections into the odometry, and the squares again; a further pass only where it can pay (NUMBERS: E_max > 3
// standard errors).
void calibrate_and_drive_again(ExperimentResult& result, int next_number, Driving driving) {
  const CalibrationChoice& choice = result.scenario.calibration;
  const std::optional<CalibrationMethod> method = result.applied();
  if (!method) return;
  OdometryParameters odometry = result.odometry;
  const Umbmark* last = &*result.umbmark;
  result.passes.reserve(std::size_t(choice.max_passes));
  driving.rows.folder /= "calibrated";
  for (int pass = 0; pass < choice.max_passes && (pass == 0 || another_pass(*last)); ++pass) {
    odometry = corrected(odometry, estimate(*last, *method));
    CalibrationPass done{{empty_recording(result.scenario, result.nominal), {}, {}, {}}, odometry, {}};
    const std::vector<RunSpec> specs = plan_runs(result.scenario, false, next_number);
    next_number += int(specs.size());
    if (driving.rows.to == Rows::To::folder) std::filesystem::remove_all(driving.rows.folder);  // the last pass counts
    drive_all(result, odometry, specs, done, driving);
    done.umbmark = umbmark_of(done, odometry);
    result.passes.push_back(std::move(done));
    last = &result.passes.back().umbmark;
  }
}

// The nominal robot, what is injected into it, and what is to be said before anything is driven.
ExperimentResult begun(const Scenario& scenario, const RunSpec& first) {
  ExperimentResult result;
  result.scenario = scenario;
  result.nominal = load_scenario_robot(scenario);
  result.odometry = initial_odometry(scenario, result.nominal);
  Scenario quiet = scenario;
  quiet.noise = {};
  const Rig rig = rig_for(quiet, result.nominal, first);
  result.injected = injected_errors(rig, result.odometry);
  result.odometry.ticks_per_revolution = rig.encoders.ticks_per_revolution;
  check_control_loop(scenario, rig);
  result.warnings = assumed_of_robot(scenario);
  for (const std::string& silent : silent_effects(scenario, result.nominal)) result.warnings.push_back(silent);
  result.recording = empty_recording(scenario, result.nominal);
  return result;
}

}  // namespace

ExperimentResult run_experiment(const Scenario& scenario, int jobs, bool show_progress, const Rows& rows,
                                const std::function<void()>& lap_done) {
  const auto start = std::chrono::steady_clock::now();
  std::optional<tbb::global_control> limit;
  if (jobs > 0) limit.emplace(tbb::global_control::max_allowed_parallelism, std::size_t(jobs));
  std::vector<RunSpec> specs = plan_runs(scenario, false, 0);
  ExperimentResult result = begun(scenario, specs.front());
  if (scenario.bumps.any()) {
    const std::vector<RunSpec> bumped = plan_runs(scenario, true, int(specs.size()));
    specs.insert(specs.end(), bumped.begin(), bumped.end());
  }
  const Driving driving{rows, show_progress, lap_done};
  drive_all(result, result.odometry, specs, result, driving);
  measure(result);
  calibrate_and_drive_again(result, int(specs.size()), driving);
  for (std::string& warning : run_warnings(result)) result.warnings.push_back(std::move(warning));
  result.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace umbsim
