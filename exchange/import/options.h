#pragma once

#include <optional>
#include <string>

#include "core/pose2.h"

namespace umbsim::exchange {

/// What the user says of a source. Empty: the source must tell, or it is asked for by the option's name.
struct ImportOptions {
  std::string source;
  std::string truth_file;  ///< the truth, where it is not in the source
  std::string title;

  // Columns of a CSV file.
  std::string time_column, left_column, right_column, left_command_column, right_command_column;
  std::string x_column, y_column, heading_column;
  std::string unit;          ///< of the wheels' columns
  std::string counts;        ///< cumulative | per-sample
  std::string time_unit;     ///< s | ms | us | ns
  std::string truth_unit;    ///< m | cm | mm
  std::string heading_unit;  ///< rad | deg

  // Topics of a bag, or the beginning of columns' names.
  std::string encoders, truth;
  std::string commands;  ///< topic of a bag; `none`: leave them out
  std::string left_joint, right_joint;

  // The robot.
  std::string robot_file;
  std::optional<double> wheel_radius_m, wheelbase_m, ticks_per_revolution;

  // The tracker.
  std::string times_file;               ///< of KITTI poses
  std::optional<double> truth_rate_hz;  ///< the same
  std::string up = "+z";                ///< which axis of the tracker points up
  std::optional<Pose2> X_BT;            ///< the tracked frame T on the robot's body
  double truth_offset_s = 0;            ///< is added to the tracker's times
  bool keep_frame = false;              ///< poses stay in the tracker's frame
  std::optional<double> position_sd_m, heading_sd_rad;

  // The runs.
  std::string cut = "auto";  ///< auto | none | standstills | squares
  std::string runs_file;
  double still_s = 2;  ///< standstills that part runs take this long
  std::optional<double> side_m;
};

}  // namespace umbsim::exchange
