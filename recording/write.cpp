#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <set>

#include "core/error.h"
#include "core/text/text_file.h"
#include "core/text/yaml_text.h"
#include "recording/names.h"
#include "recording/run_writer.h"

namespace umbsim {
namespace {

namespace fs = std::filesystem;
using Text = fmt::memory_buffer;

void append(Text& text, std::string_view piece) { text.append(piece); }

void append_number(Text& text, std::string_view before, const char* key, std::optional<double> value) {
  if (value) fmt::format_to(fmt::appender(text), "{}{}: {}", before, key, yaml_number(*value, key));
}

std::string urdf_name(const RecordedRobot& robot) { return fs::path(robot.urdf).filename().string(); }

void append_robot(Text& text, const RecordedRobot& robot) {
  append(text, "\nrobot:");
  if (!robot.urdf.empty()) append(text, "\n  urdf: " + yaml_string(urdf_name(robot)));
  append_number(text, "\n  ", "wheel_radius_m", robot.wheel_radius_m);
  append_number(text, "\n  ", "wheelbase_m", robot.wheelbase_m);
  append_number(text, "\n  ", "ticks_per_revolution", robot.ticks_per_revolution);
  if (!robot.left_joint.empty()) append(text, "\n  left_joint: " + yaml_string(robot.left_joint));
  if (!robot.right_joint.empty()) append(text, "\n  right_joint: " + yaml_string(robot.right_joint));
}

void append_waypoints(Text& text, const std::vector<Waypoint>& waypoints) {
  const char* before = "\n  waypoints_m: [";
  for (const Waypoint& w : waypoints) {
    append(text, fmt::format("{}[{}, {}]", before, yaml_number(w.x_m, "x_m"), yaml_number(w.y_m, "y_m")));
    before = ", ";
  }
  if (!waypoints.empty()) append(text, "]");
}

void append_path(Text& text, const RecordedPath& path) {
  append(text, "\npath:\n  shape: " + yaml_string(path.shape));
  if (path.shape == "square") append_number(text, "\n  ", "side_m", path.side_m);
  append_number(text, "\n  ", "radius_m", path.radius_m);
  append_waypoints(text, path.waypoints);
  if (path.shape == "square" || path.turn != "in_place") append(text, "\n  turn: " + yaml_string(path.turn));
  append_number(text, "\n  ", "turn_radius_m", path.turn_radius_m);
  append_number(text, "\n  ", "linear_speed_mps", path.linear_speed_mps);
  append_number(text, "\n  ", "angular_speed_radps", path.angular_speed_radps);
  append_number(text, "\n  ", "linear_acceleration_mps2", path.linear_acceleration_mps2);
  append_number(text, "\n  ", "angular_acceleration_radps2", path.angular_acceleration_radps2);
}

void append_bumps(Text& text, const std::vector<RecordedBump>& bumps) {
  const char* before = ", bumps: [";
  for (const RecordedBump& bump : bumps) {
    append(text, before);
    append_number(text, "{", "x_m", bump.x_m);
    append_number(text, ", ", "y_m", bump.y_m);
    append_number(text, ", ", "height_m", bump.height_m);
    append(text, "}");
    before = ", ";
  }
  if (!bumps.empty()) append(text, "]");
}

void append_run(Text& text, const RecordedRun& run) {
  append(text, "\n  - {id: " + yaml_string(run.id) + ", direction: " + yaml_string(run.direction));
  append_number(text, ", ", "start_heading_rad", run.start_heading_rad);
  append_number(text, ", ", "linear_speed_mps", run.linear_speed_mps);
  if (run.turn) append(text, ", turn: " + yaml_string(*run.turn));
  append_number(text, ", ", "turn_radius_m", run.turn_radius_m);
  append_number(text, ", ", "payload_kg", run.payload_kg);
  append_bumps(text, run.bumps);
  if (run.inner_wheel_bumps) append(text, fmt::format(", inner_wheel_bumps: {}", *run.inner_wheel_bumps));
  const std::string folder = "runs/" + run.id + "/";
  append(text, ", encoders: " + yaml_string(folder + "encoders.csv"));
  append(text, ", truth: " + yaml_string(folder + "truth.csv") + "}");
}

Text recording_text(const Recording& recording) {
  Text text;
  append(text, "format: " + std::string(kRecordingFormat));
  append(text, "\ntitle: " + yaml_string(recording.title));
  if (!recording.source.empty()) append(text, "\nsource: " + yaml_string(recording.source));
  append_robot(text, recording.robot);
  append_path(text, recording.path);
  append_number(text, "\nencoders:\n  ", "rate_hz", recording.encoder_rate_hz);
  append(text, "\ntruth:\n  kind: " + yaml_string(recording.truth_kind));
  append_number(text, "\n  ", "position_sd_m", recording.truth_position_sd_m);
  append_number(text, "\n  ", "heading_sd_rad", recording.truth_heading_sd_rad);
  append(text, "\nruns:");
  for (const RecordedRun& run : recording.runs) append_run(text, run);
  append(text, "\n");
  return text;
}

void write_run(const RecordedRun& run, const fs::path& directory) {
  RunWriter writer(directory, run.id, run.has_commands);
  for (const EncoderSample& row : run.encoders) writer.add(row);
  for (const TruthSample& row : run.truth) writer.add(row);
  writer.finish();
}

}  // namespace

void write_recording_header(const Recording& recording, const fs::path& directory) {
  std::set<std::string> ids;
  for (const RecordedRun& run : recording.runs) {
    if (!ids.insert(run.id).second) throw RunError(fmt::format("two runs have the id '{}'", run.id));
  }
  const Text text = recording_text(recording);
  const RecordedRobot& robot = recording.robot;
  if (!robot.urdf_text.empty()) write_text_file(directory / urdf_name(robot), robot.urdf_text);
  write_text_file(directory / "recording.yaml", {text.data(), text.size()});
}

void write_recording(const Recording& recording, const fs::path& directory) {
  write_recording_header(recording, directory);
  // Turning numbers into text takes as long as driving.
  tbb::parallel_for(std::size_t(0), recording.runs.size(),
                    [&](std::size_t r) { write_run(recording.runs[r], directory); });
}

}  // namespace umbsim
