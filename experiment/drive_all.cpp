#include "experiment/drive_all.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "core/first_failure.h"
#include "core/progress.h"
#include "effects/silent.h"
#include "experiment/scenario/recorded_course.h"
#include "recording/names.h"

namespace umbsim {
namespace {

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

}  // namespace

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

Recording empty_recording(const Scenario& s, const RobotModel& nominal) {
  Recording r;
  r.title = s.description.empty() ? s.name : s.description;
  r.source = "umbsim, scenario " + s.name;
  r.robot = {
      urdf_copy_name(nominal.urdf), nominal.wheels[0].radius_m, nominal.wheelbase_m(), s.encoders.ticks_per_revolution,
      scenario_urdf_text(s),        s.robot.joints.left,        s.robot.joints.right};
  r.path = recorded_path(s.course);
  r.encoder_rate_hz = s.encoders.rate_hz;
  r.truth_kind = s.truth.kind;
  r.truth_position_sd_m = s.truth.position_sd_m;
  r.truth_heading_sd_rad = s.truth.heading_sd_rad;
  return r;
}

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

std::vector<std::string> silent_effects(const Scenario& scenario, const RobotModel& nominal) {
  Scenario bare = scenario;
  bare.noise = {};
  bare.effects.clear();
  std::vector<Rig> rigs;
  for (const RunSpec& spec : plan_runs(scenario, false, 0)) rigs.push_back(rig_for(bare, nominal, spec));
  return silent_effects(scenario.effects, rigs);
}

}  // namespace umbsim
