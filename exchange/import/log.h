#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/pose2.h"

namespace umbsim::exchange {

/// Times of a log: integers, as a double of Unix seconds holds no microseconds.
using Nanoseconds = std::int64_t;

/// What the numbers of a wheel count.
enum class WheelUnit { ticks, rad, deg, rev, m, mm, cm, radps, degps, rpm, mps, mmps };

/// As options and messages name it: "rad/s".
const char* name(WheelUnit unit);
std::optional<WheelUnit> wheel_unit(const std::string& name);
const std::vector<std::string>& wheel_unit_names();
bool is_rate(WheelUnit unit);
/// Whether a length, which needs the wheel's radius to become an angle.
bool is_length(WheelUnit unit);

/// One wheel over time, as the source has it.
struct WheelSignal {
  std::string name;  ///< its column, or its topic and joint
  WheelUnit unit = WheelUnit::ticks;
  bool per_sample = false;  ///< what was added since the sample before, not the sum
  std::vector<Nanoseconds> at;
  std::vector<double> value;
};

/// A tracked pose over time, in metres, radians (unwrapped) and the tracker's own frame.
struct Track {
  std::string name;
  std::vector<Nanoseconds> at;
  std::vector<Pose2> pose;
};

/// Commanded speeds of the body, as a drive controller takes them.
struct BodyCommands {
  std::string name;
  std::vector<Nanoseconds> at;
  std::vector<double> linear_mps, angular_radps;
};

/// What was found in a source, before it is a recording.
struct Log {
  WheelSignal left, right;
  std::optional<WheelSignal> left_command, right_command;
  std::optional<BodyCommands> body_command;  ///< where the wheels' own are not known
  Track truth;
  std::vector<std::string> found;  ///< what was understood, a line each, for the reader to check
};

}  // namespace umbsim::exchange
