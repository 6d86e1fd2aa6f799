#include "experiment/run.h"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>

#include "core/progress.h"
#include "effects/silent.h"
#include "experiment/check_loop.h"
#include "experiment/course/recorded_course.h"
#include "experiment/first_failure.h"
#include "experiment/wheel_loads.h"
#include "recording/names.h"

namespace umbsim {
namespace {

// Differences of E_max below this are the solver's and the quantisation's: no reason for another pass.
constexpr double kWorthCalibrating_m = 1e-4;

std::vector<RunSpec> plan_runs(const Scenario& s, bool bumped, int first_number) {
  std::vector<RunSpec> specs;
  int number = first_number;
  for (int i = 1; i <= s.runs.per_direction; ++i) {
    for (const Direction d : s.runs.directions) {
      specs.push_back({fmt::format("{}{}-{}", name(d), bumped ? "-bumped" : "", i), d, bumped, number++});
    }
  }
  return specs;
}

// Poses of a run that go into the page: at most so many, and of all runs together about so many.
constexpr std::size_t kRunPoses = 400;
constexpr std::size_t kPagePoses = 24000;
constexpr std::size_t kFewestRunPoses = 40;

std::size_t path_poses(std::size_t runs) {
  return std::clamp(kPagePoses / std::max<std::size_t>(1, runs), kFewestRunPoses, kRunPoses);
}

void add(ExperimentResult& result, DrivenRun&& run, DrivenRuns& into) {
  result.cost.steps += run.cost.steps;
  result.cost.newton_steps += run.cost.newton_steps;
  result.cost.solver_fallbacks += run.cost.solver_fallbacks;
  result.cost.simulated_s += run.cost.simulated_s;
  result.cables.not_crossed += run.cables.not_crossed;
  result.cables.without_grip += run.cables.without_grip;
  into.recording.runs.push_back(std::move(run.run));
  into.digests.push_back(std::move(run.digest));
  into.tracks.push_back(std::move(run.track));
  into.strains.push_back(run.strain);
}

// How an experiment is driven, whatever it is.
struct Driving {
  Rows rows;
  bool show_progress;
  std::function<void()> lap_done;
};

void drive_all(ExperimentResult& result, const OdometryParameters& odometry, const std::vector<RunSpec>& specs,
               DrivenRuns& into, const Driving& driving) {
  const int laps = result.scenario.course.laps;
  std::optional<Progress> progress;
  if (driving.show_progress) progress.emplace(laps > 1 ? "driving laps" : "driving", int(specs.size()) * laps);
  const RunOutput output{driving.rows, path_poses(specs.size()), [&] {
                           if (driving.lap_done) driving.lap_done();
                           if (progress) progress->step();
                         }};
  std::vector<DrivenRun> driven(specs.size());
  FirstFailure failure;
  tbb::parallel_for(std::size_t(0), specs.size(), [&](std::size_t i) {
    failure.attempt(i, [&] { driven[i] = drive_run(result.scenario, result.nominal, odometry, specs[i], output); });
  });
  failure.rethrow();
  for (DrivenRun& run : driven) add(result, std::move(run), into);
}

Recording empty_recording(const Scenario& s, const RobotModel& nominal) {
  Recording r;
  r.title = s.description.empty() ? s.name : s.description;
  r.source = "umbsim, scenario " + s.name;
  r.robot = {urdf_copy_name(nominal.urdf),      nominal.wheels[0].radius_m, nominal.wheelbase_m(),
             s.encoders.ticks_per_revolution, scenario_urdf_text(s),      s.robot.joints.left,
             s.robot.joints.right};
  r.path = recorded_path(s.course);
  r.encoder_rate_hz = s.encoders.rate_hz;
  r.truth_kind = s.truth.kind;
  r.truth_position_sd_m = s.truth.position_sd_m;
  r.truth_heading_sd_rad = s.truth.heading_sd_rad;
  return r;
}

Cluster cluster_of(const DrivenRuns& driven, const char* direction, bool bumped) {
  std::vector<ReturnError> errors;
  for (std::size_t i = 0; i < driven.digests.size(); ++i) {
    const RecordedRun& run = driven.recording.runs[i];
    if (run.direction == direction && is_bumped(run) == bumped) errors.push_back(driven.digests[i].error);
  }
  return cluster(std::move(errors));
}

Umbmark umbmark_of(const DrivenRuns& driven, const OdometryParameters& odometry) {
  return umbmark(cluster_of(driven, "cw", false), cluster_of(driven, "ccw", false), driven.recording.path.side_m,
                 odometry.wheelbase_m);
}

void measure(ExperimentResult& result) {
  result.cw = cluster_of(result, "cw", false);
  result.ccw = cluster_of(result, "ccw", false);
  if (result.scenario.runs.directions.size() < 2 || result.scenario.course.shape != "square") return;
  result.umbmark = umbmark_of(result, result.odometry);
  Cluster cw = cluster_of(result, "cw", true), ccw = cluster_of(result, "ccw", true);
  if (cw.errors.empty() || ccw.errors.empty()) return;
  result.extended = extended_umbmark(std::move(cw), std::move(ccw), *result.umbmark, bump_count(result.recording));
}

bool another_pass(const Umbmark& u) {
  const double standard_error_m = std::max(u.cw.standard_error_m, u.ccw.standard_error_m);
  return u.e_max_syst_m > 3 * standard_error_m && u.e_max_syst_m > kWorthCalibrating_m;
}

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

}  // namespace

std::optional<CalibrationMethod> ExperimentResult::applied() const {
  if (scenario.calibration.method == Calibrate::none || !umbmark) return {};
  return scenario.calibration.method == Calibrate::endpoint ? CalibrationMethod::endpoint : CalibrationMethod::heading;
}

InjectedErrors injected_errors(const Rig& rig, const OdometryParameters& o) {
  const double actual = rig.robot.wheels[1].radius_m / rig.robot.wheels[0].radius_m;
  return {actual / (o.right_radius_m / o.left_radius_m), rig.robot.wheelbase_m() / o.wheelbase_m};
}

std::vector<std::string> silent_effects(const Scenario& scenario, const RobotModel& nominal) {
  Scenario bare = scenario;
  bare.noise = {};
  bare.effects.clear();
  std::vector<Rig> rigs;
  for (const RunSpec& spec : plan_runs(scenario, false, 0)) rigs.push_back(rig_for(bare, nominal, spec));
  return silent_effects(scenario.effects, rigs);
}

ExperimentResult run_experiment(const Scenario& scenario, int jobs, bool show_progress, const Rows& rows,
                                const std::function<void()>& lap_done) {
  const auto start = std::chrono::steady_clock::now();
  std::optional<tbb::global_control> limit;
  if (jobs > 0) limit.emplace(tbb::global_control::max_allowed_parallelism, std::size_t(jobs));
  ExperimentResult result;
  result.scenario = scenario;
  result.nominal = load_scenario_robot(scenario);
  result.odometry = initial_odometry(scenario, result.nominal);
  std::vector<RunSpec> specs = plan_runs(scenario, false, 0);
  Scenario quiet = scenario;
  quiet.noise = {};
  const Rig rig = rig_for(quiet, result.nominal, specs.front());
  result.injected = injected_errors(rig, result.odometry);
  result.odometry.ticks_per_revolution = rig.encoders.ticks_per_revolution;
  check_control_loop(scenario, rig);
  result.warnings = assumed_of_robot(scenario);
  for (const std::string& silent : silent_effects(scenario, result.nominal)) result.warnings.push_back(silent);

  if (scenario.bumps.any()) {
    const std::vector<RunSpec> bumped = plan_runs(scenario, true, int(specs.size()));
    specs.insert(specs.end(), bumped.begin(), bumped.end());
  }
  result.recording = empty_recording(scenario, result.nominal);
  const Driving driving{rows, show_progress, lap_done};
  drive_all(result, result.odometry, specs, result, driving);
  measure(result);

  calibrate_and_drive_again(result, int(specs.size()), driving);
  for (std::string& warning : run_warnings(result)) result.warnings.push_back(std::move(warning));
  result.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace umbsim
