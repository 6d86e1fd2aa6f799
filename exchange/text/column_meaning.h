#pragma once

#include <string>
#include <vector>

namespace umbsim::exchange {

/// What a column may hold, told from its name.
enum class Role { other, time, left, right, left_command, right_command, x, y, z, qx, qy, qz, qw, heading };

struct ColumnMeaning {
  Role role = Role::other;
  std::string unit;         ///< "rad/s", "ms", ...; empty where the name does not say it
  bool ros = false;         ///< its unit is that of the ROS message, by convention
  bool rate = false;        ///< a speed, whatever its unit
  bool per_sample = false;  ///< "delta_left"
  std::string group;        ///< what stands before x, y and heading: poses of one group belong together
};

/// "left_wheel [rad]", "/joint_states/wheel_left_joint/position", "truth.x_mm", "posX (m)".
ColumnMeaning meaning_of(const std::string& column);

/// Lower-case words of a name: cut at signs, at capitals and between letters and digits.
std::vector<std::string> words_in(const std::string& name);

/// 'l' for a left wheel's, 'r' for a right one's, 0 where the words do not tell or tell both.
char side_of(const std::vector<std::string>& words);

}  // namespace umbsim::exchange
