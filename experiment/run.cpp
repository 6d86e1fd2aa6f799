#include "experiment/run.h"

#include <chrono>

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include "core/progress.h"

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

void drive_all(ExperimentResult& result, const OdometryParameters& odometry, const std::vector<RunSpec>& specs,
               Recording& recording, std::vector<PoseTrack>& tracks, bool show_progress) {
  std::optional<Progress> progress;
  if (show_progress) progress.emplace("driving", int(specs.size()));
  std::vector<DrivenRun> driven(specs.size());
  tbb::parallel_for(std::size_t(0), specs.size(), [&](std::size_t i) {
    driven[i] = drive_run(result.scenario, result.nominal, odometry, specs[i]);
    if (progress) progress->step();
  });
  for (DrivenRun& d : driven) {
    result.cost.steps += d.cost.steps;
    result.cost.newton_steps += d.cost.newton_steps;
    result.cost.solver_fallbacks += d.cost.solver_fallbacks;
    result.cost.simulated_s += d.cost.simulated_s;
    result.cables.not_crossed += d.cables.not_crossed;
    result.cables.without_grip += d.cables.without_grip;
    recording.runs.push_back(std::move(d.run));
    tracks.push_back(std::move(d.track));
  }
}

Recording empty_recording(const Scenario& s, const RobotModel& nominal, const OdometryParameters& odometry) {
  Recording r;
  r.title = s.description.empty() ? s.name : s.description;
  r.source = "umbsim, scenario " + s.name;
  r.robot = {nominal.urdf, nominal.wheels[0].radius_m, nominal.wheelbase_m(), odometry.ticks_per_revolution};
  r.path.side_m = s.course.side_m;
  r.path.turn = s.course.turn;
  if (s.course.turn == "arc") r.path.turn_radius_m = s.course.turn_radius_m;
  r.path.linear_speed_mps = s.course.linear_speed_mps;
  r.path.angular_speed_radps = s.course.angular_speed_radps;
  r.path.linear_acceleration_mps2 = s.course.linear_acceleration_mps2;
  r.path.angular_acceleration_radps2 = s.course.angular_acceleration_radps2;
  r.encoder_rate_hz = s.encoders.rate_hz;
  r.truth_kind = s.truth.kind;
  r.truth_position_sd_m = s.truth.position_sd_m;
  r.truth_heading_sd_rad = s.truth.heading_sd_rad;
  return r;
}

void measure(ExperimentResult& result) {
  result.cw = cluster(return_errors(result.recording, result.odometry, "cw", false));
  result.ccw = cluster(return_errors(result.recording, result.odometry, "ccw", false));
  if (result.scenario.runs.directions.size() < 2) return;
  result.umbmark = umbmark(result.recording, result.odometry);
  result.extended = extended_umbmark(result.recording, result.odometry, *result.umbmark);
}

bool another_pass(const Umbmark& u) {
  const double standard_error_m = std::max(u.cw.standard_error_m, u.ccw.standard_error_m);
  return u.e_max_syst_m > 3 * standard_error_m && u.e_max_syst_m > kWorthCalibrating_m;
}

// Corrections into the odometry, and the squares again; a further pass only where it can pay (NUMBERS: E_max > 3
// standard errors).
void calibrate_and_drive_again(ExperimentResult& result, int next_number, bool show_progress) {
  const CalibrationChoice& choice = result.scenario.calibration;
  if (choice.method == Calibrate::none || !result.umbmark) return;
  const auto method =
      choice.method == Calibrate::endpoint ? CalibrationMethod::endpoint : CalibrationMethod::heading;
  OdometryParameters odometry = result.odometry;
  const Umbmark* last = &*result.umbmark;
  result.passes.reserve(std::size_t(choice.max_passes));
  for (int pass = 0; pass < choice.max_passes && (pass == 0 || another_pass(*last)); ++pass) {
    odometry = corrected(odometry, estimate(*last, method));
    CalibrationPass done{odometry, empty_recording(result.scenario, result.nominal, result.odometry), {}, {}};
    const std::vector<RunSpec> specs = plan_runs(result.scenario, false, next_number);
    next_number += int(specs.size());
    drive_all(result, odometry, specs, done.recording, done.tracks, show_progress);
    done.umbmark = umbmark(done.recording, odometry);
    result.passes.push_back(std::move(done));
    last = &result.passes.back().umbmark;
  }
}

}  // namespace

InjectedErrors injected_errors(const Rig& rig, const OdometryParameters& o) {
  const double actual = rig.robot.wheels[1].radius_m / rig.robot.wheels[0].radius_m;
  return {actual / (o.right_radius_m / o.left_radius_m), rig.robot.wheelbase_m() / o.wheelbase_m};
}

ExperimentResult run_experiment(const Scenario& scenario, int jobs, bool show_progress) {
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

  if (scenario.bumps.any()) {
    const std::vector<RunSpec> bumped = plan_runs(scenario, true, int(specs.size()));
    specs.insert(specs.end(), bumped.begin(), bumped.end());
  }
  result.recording = empty_recording(scenario, result.nominal, result.odometry);
  drive_all(result, result.odometry, specs, result.recording, result.tracks, show_progress);
  measure(result);

  calibrate_and_drive_again(result, int(specs.size()), show_progress);
  result.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace umbsim
