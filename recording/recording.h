#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/pose2.h"

namespace umbsim {

/// One row of encoders.csv. Ticks are cumulative, positive when the wheel rolls forward; commands are wheel
/// angular velocities.
struct EncoderSample {
  double time_s = 0;
  std::int64_t left_ticks = 0;
  std::int64_t right_ticks = 0;
  double left_command_radps = 0;
  double right_command_radps = 0;
};

/// One row of truth.csv: absolute pose of the axle's middle in the floor frame.
struct TruthSample {
  double time_s = 0;
  Pose2 X_WB;
};

/// A cable that the experimenter laid.
struct RecordedBump {
  double x_m = 0;
  double y_m = 0;
  double height_m = 0;
};

/// What the experimenter believes of the robot, not what is true.
struct RecordedRobot {
  std::string urdf;  ///< name of a file beside recording.yaml or in robots/, without folders; empty if not given
  double wheel_radius_m = 0;
  double wheelbase_m = 0;
  double ticks_per_revolution = 0;
  std::string urdf_text{};    ///< content of that file; empty if it does not lie beside recording.yaml
  std::string left_joint{};   ///< which wheels drive, where the URDF alone does not tell; else empty
  std::string right_joint{};
};

/// A place that the robot drives to, in the frame of its start.
struct Waypoint {
  double x_m = 0;
  double y_m = 0;
};

struct RecordedPath {
  std::string shape = "square";      ///< square | circle | figure_eight | path | free
  double side_m = 0;                 ///< square only
  std::optional<double> radius_m;    ///< circle and figure_eight only, where it is known
  std::vector<Waypoint> waypoints;   ///< path only, where they are known: as driven ccw, mirrored for cw
  std::string turn = "in_place";
  std::optional<double> turn_radius_m;
  std::optional<double> linear_speed_mps;
  std::optional<double> angular_speed_radps;
  std::optional<double> linear_acceleration_mps2;
  std::optional<double> angular_acceleration_radps2;
};

struct RecordedRun {
  std::string id;
  std::string direction;  ///< cw | ccw | free
  // Optional, overriding the path's.
  std::optional<double> start_heading_rad;
  std::optional<double> linear_speed_mps;
  std::optional<std::string> turn;
  std::optional<double> turn_radius_m;
  std::optional<double> payload_kg;
  std::vector<RecordedBump> bumps;
  /// `plain` runs have none of the bumps that the experimenter lays under the inner wheel, `bumped` runs have them.
  std::optional<int> inner_wheel_bumps;

  bool has_commands = false;
  std::vector<EncoderSample> encoders;
  std::vector<TruthSample> truth;
};

/// What a robot, real or simulated, left behind (docs: recording format, version 1).
struct Recording {
  std::string title;
  std::string source;
  RecordedRobot robot;
  RecordedPath path;
  double encoder_rate_hz = 0;
  std::string truth_kind = "track";  ///< track | endpoints
  double truth_position_sd_m = 0;
  double truth_heading_sd_rad = 0;
  std::vector<RecordedRun> runs;
};

/// Reads a recording's directory. Throws InputError with file, line, key and value: missing files, unknown or
/// duplicate keys, truncated rows, times that do not increase, non-finite numbers, no motion data.
Recording read_recording(const std::filesystem::path& directory);

/// Writes recording.yaml, the robot's URDF where its text is known, and runs/<id>/{encoders,truth}.csv into an existing
/// directory. The text is the same for the same values on every run. Throws RunError if a file cannot be written completely.
void write_recording(const Recording& recording, const std::filesystem::path& directory);

}  // namespace umbsim
