#include <filesystem>

#include "experiment/replay.h"

namespace umbsim {

Scenario scenario_of(const Recording& recording, const std::string& directory) {
  Scenario s;
  s.file = (std::filesystem::path(directory) / "recording.yaml").string();
  s.name = "twin";
  if (!recording.robot.urdf.empty()) s.robot.urdf = recording.robot.urdf;
  s.robot.joints = {recording.robot.left_joint, recording.robot.right_joint};
  s.encoders.ticks_per_revolution = recording.robot.ticks_per_revolution;
  s.encoders.rate_hz = recording.encoder_rate_hz;
  const RecordedPath& p = recording.path;
  if (p.side_m > 0) s.course.side_m = p.side_m;
  s.course.turn = p.turn;
  if (p.turn_radius_m) s.course.turn_radius_m = *p.turn_radius_m;
  if (p.linear_speed_mps) s.course.linear_speed_mps = *p.linear_speed_mps;
  if (p.angular_speed_radps) s.course.angular_speed_radps = *p.angular_speed_radps;
  if (p.linear_acceleration_mps2) s.course.linear_acceleration_mps2 = *p.linear_acceleration_mps2;
  if (p.angular_acceleration_radps2) s.course.angular_acceleration_radps2 = *p.angular_acceleration_radps2;
  s.truth.kind = recording.truth_kind;
  s.truth.position_sd_m = recording.truth_position_sd_m;
  s.truth.heading_sd_rad = recording.truth_heading_sd_rad;
  return s;
}

}  // namespace umbsim
