#include "cli/gap/gap_menu.h"

#include <algorithm>
#include <cmath>

#include "experiment/drive/planned_runs.h"
#include "gap/noise/clock.h"

namespace umbsim {
namespace {

constexpr double kPayloadShare = 0.375;  // of the base's mass: 15 kg on a LabMate of 40 kg, as in a trial
constexpr double kPayloadGrain_kg = 0.5;

// Beliefs of the recording go before the URDF's, as in a replay.
RobotModel believed(const Scenario& scenario, const RecordedRobot& robot) {
  Rig rig;
  rig.robot = load_scenario_robot(scenario);
  Effect scale = neutral_effect(find_effect("wheel_radius_scale"));
  scale.values.numbers = {robot.wheel_radius_m / rig.robot.wheels[0].radius_m - 1};
  Effect base = neutral_effect(find_effect("wheelbase"));
  base.values.numbers = {robot.wheelbase_m / rig.robot.wheelbase_m() - 1};
  return apply_effects({scale, base}, std::move(rig)).robot;
}

// The menu is of squares, whatever was driven before.
RecordedPath as_square(RecordedPath path, const Course& course) {
  if (path.shape == "square") return path;
  path.shape = "square";
  path.side_m = course.side_m;
  path.radius_m.reset();
  path.waypoints.clear();
  return path;
}

}  // namespace

Scenario nominal_scenario(Scenario s) {
  s.effects.clear();
  s.noise = {};
  s.bumps = {};
  s.uncertainty = {};
  s.fixes.clear();
  s.odometry = {};
  s.expect.clear();
  s.calibration.method = Calibrate::none;
  s.truth.position_sd_m = s.truth.heading_sd_rad = 0;
  return s;
}

std::vector<gap::MenuRun> menu_for(const Scenario& scenario, const RecordedPath& path) {
  const double mass_kg = load_scenario_robot(scenario).base.mass_kg;
  const double payload_kg = std::max(1.0, std::round(kPayloadShare * mass_kg / kPayloadGrain_kg)) * kPayloadGrain_kg;
  return gap::plan_menu(as_square(path, scenario.course), scenario.course.dwell_s, payload_kg);
}

Recording with_menu(Recording recording, const Scenario& scenario, const std::vector<gap::MenuRun>& menu) {
  const Scenario nominal = nominal_scenario(scenario);
  const RobotModel robot = believed(nominal, recording.robot);
  for (const gap::MenuRun& m : menu) {
    Scenario s = nominal;
    s.course.dwell_s = m.dwell_s;
    Recording planned = recording;
    planned.runs = {m.run};
    planned.truth_position_sd_m = planned.truth_heading_sd_rad = 0;
    planned.path = as_square(planned.path, s.course);
    planned.path.side_m = s.course.side_m;
    planned.path.turn = "in_place";
    planned.path.angular_speed_radps = m.angular_speed_radps;
    recording.runs.push_back(drive_planned_runs(s, robot, std::move(planned)).runs.front());
  }
  return gap::with_moments_between(std::move(recording));
}

}  // namespace umbsim
