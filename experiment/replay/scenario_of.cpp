#include <filesystem>

#include "experiment/replay/replay.h"
#include "experiment/scenario/recorded_course.h"

namespace umbsim {

Scenario scenario_of(const Recording& recording, const std::string& directory) {
  Scenario s;
  s.file = (std::filesystem::path(directory) / "recording.yaml").string();
  s.name = "twin";
  if (!recording.robot.urdf.empty()) s.robot.urdf = recording.robot.urdf;
  s.robot.joints = {recording.robot.left_joint, recording.robot.right_joint};
  s.encoders.ticks_per_revolution = recording.robot.ticks_per_revolution;
  s.encoders.rate_hz = recording.encoder_rate_hz;
  set_course(s.course, recording.path);
  s.truth.kind = recording.truth_kind;
  s.truth.position_sd_m = recording.truth_position_sd_m;
  s.truth.heading_sd_rad = recording.truth_heading_sd_rad;
  return s;
}

}  // namespace umbsim
