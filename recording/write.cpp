#include <fmt/compile.h>
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <set>

#include "core/error.h"
#include "core/text_file.h"
#include "recording/names.h"
#include "recording/recording.h"
#include "recording/yaml_text.h"

namespace umbsim {
namespace {

namespace fs = std::filesystem;
using Text = fmt::memory_buffer;

/// `value` to the nearest 1e-9 (of metre, radian, second), below any sensor; so 0.1 + 0.2 is written as 0.3.
double rounded(double value) {
  constexpr double kDecimals = 1e9;
  constexpr double kLargest = 9e6;  // above, 1e-9 is finer than a double
  if (std::abs(value) > kLargest) return value;
  return std::round(value * kDecimals) / kDecimals + 0.0;  // + 0.0 turns -0 into 0
}

void check_finite(bool finite, const RecordedRun& run, const char* file, double time_s) {
  if (!finite) throw RunError(fmt::format("run '{}': {} has a non-finite value at {} s", run.id, file, time_s));
}

Text encoders_text(const RecordedRun& run) {
  Text text;
  text.append(std::string_view("time_s,left_ticks,right_ticks"));
  if (run.has_commands) text.append(std::string_view(",left_command_radps,right_command_radps"));
  text.push_back('\n');
  const fmt::appender out(text);
  for (const EncoderSample& row : run.encoders) {
    const double left = row.left_command_radps, right = row.right_command_radps;
    check_finite(std::isfinite(row.time_s) && std::isfinite(left) && std::isfinite(right), run, "encoders.csv",
                 row.time_s);
    fmt::format_to(out, FMT_COMPILE("{},{},{}"), rounded(row.time_s), row.left_ticks, row.right_ticks);
    if (run.has_commands) fmt::format_to(out, FMT_COMPILE(",{},{}"), rounded(left), rounded(right));
    text.push_back('\n');
  }
  return text;
}

Text truth_text(const RecordedRun& run) {
  Text text;
  text.append(std::string_view("time_s,x_m,y_m,theta_rad\n"));
  for (const TruthSample& row : run.truth) {
    const Pose2& X_WB = row.X_WB;
    check_finite(std::isfinite(row.time_s) && std::isfinite(X_WB.x_m) && std::isfinite(X_WB.y_m) &&
                     std::isfinite(X_WB.theta_rad),
                 run, "truth.csv", row.time_s);
    fmt::format_to(fmt::appender(text), FMT_COMPILE("{},{},{},{}\n"), rounded(row.time_s), rounded(X_WB.x_m),
                   rounded(X_WB.y_m), rounded(X_WB.theta_rad));
  }
  return text;
}

void append(Text& text, std::string_view piece) { text.append(piece); }

void append_number(Text& text, std::string_view before, const char* key, std::optional<double> value) {
  if (value) fmt::format_to(fmt::appender(text), "{}{}: {}", before, key, yaml_number(*value, key));
}

void append_robot(Text& text, const RecordedRobot& robot) {
  append(text, "\nrobot:");
  if (!robot.urdf.empty()) append(text, "\n  urdf: " + yaml_string(fs::path(robot.urdf).filename().string()));
  append_number(text, "\n  ", "wheel_radius_m", robot.wheel_radius_m);
  append_number(text, "\n  ", "wheelbase_m", robot.wheelbase_m);
  append_number(text, "\n  ", "ticks_per_revolution", robot.ticks_per_revolution);
}

void append_path(Text& text, const RecordedPath& path) {
  append(text, "\npath:\n  shape: " + yaml_string(path.shape));
  if (path.shape == "square") append_number(text, "\n  ", "side_m", path.side_m);
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

void write(const fs::path& file, const Text& text) { write_text_file(file, {text.data(), text.size()}); }

void write_run(const RecordedRun& run, const fs::path& directory) {
  const std::string problem = run_id_problem(run.id);
  if (!problem.empty()) throw RunError(fmt::format("run id '{}' {}", run.id, problem));
  const fs::path folder = directory / "runs" / run.id;
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw RunError(fmt::format("{}: cannot be created: {}", folder.string(), error.message()));
  write(folder / "encoders.csv", encoders_text(run));
  write(folder / "truth.csv", truth_text(run));
}

}  // namespace

void write_recording(const Recording& recording, const fs::path& directory) {
  std::set<std::string> ids;
  for (const RecordedRun& run : recording.runs) {
    if (!ids.insert(run.id).second) throw RunError(fmt::format("two runs have the id '{}'", run.id));
  }
  // Turning numbers into text takes as long as driving.
  tbb::parallel_for(std::size_t(0), recording.runs.size(),
                    [&](std::size_t r) { write_run(recording.runs[r], directory); });
  write(directory / "recording.yaml", recording_text(recording));
}

}  // namespace umbsim
