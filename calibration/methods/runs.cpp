#include "calibration/methods/runs.h"

#include <fmt/format.h>

#include "umbmark/figures.h"

namespace umbsim::calibration {
namespace {

// What the run itself was driven with, where it differs from its recording.
std::string own_settings(const RecordedRun& run) {
  std::string text;
  if (run.linear_speed_mps) text += fmt::format(", {:g} m/s", *run.linear_speed_mps);
  if (run.turn) text += ", " + *run.turn + " turns";
  if (run.payload_kg) text += fmt::format(", payload {:g} kg", *run.payload_kg);
  if (run.start_heading_rad) text += fmt::format(", start at {:.0f} deg", degrees(*run.start_heading_rad));
  return text;
}

}  // namespace

Runs training_runs(const std::vector<Recording>& recordings, const std::vector<std::string>& names) {
  Runs runs;
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    for (const RecordedRun& run : recordings[i].runs) {
      if (is_bumped(run)) continue;
      runs.push_back({&recordings[i], &run, i, names[i] + " " + run.direction + own_settings(run)});
    }
  }
  return runs;
}

OdometryParameters nominal_odometry(const RecordedRobot& robot) {
  return {robot.wheel_radius_m, robot.wheel_radius_m, robot.wheelbase_m, robot.ticks_per_revolution};
}

}  // namespace umbsim::calibration
