#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "recording/recording.h"

namespace umbsim::gap {

/// Counts against commands of one run: what the drivetrain and the encoders make of what was asked.
struct CommandResponse {
  bool known = false;
  double left_gain = 0;  ///< counted over commanded rotation, minus 1
  double right_gain = 0;
  double lag_s = 0;  ///< of the counts behind the commands
  /// Wheel speed beyond the command, mean of both, along the cosine and the sine of the heading: a slope pulls so on
  /// motors that give way.
  Eigen::Vector2d by_heading_radps = Eigen::Vector2d::Zero();
  /// Speed by which wheels stay behind, mean of both, on the way and in turns in place: so friction holds back motors
  /// that give way.
  Eigen::Vector2d behind_radps = Eigen::Vector2d::Zero();
  double gain_sd = 0;              ///< of the gains, from the width of the encoder's steps
  double by_heading_sd_radps = 0;  ///< the same of by_heading_radps
  double speed_radps = 0;          ///< of the wheels, mean over the run
};

/// `counts_rad`: angles (left, right) at the encoder samples of a run with commands. `step_rad`: between
/// two counts, as wide as they really are.
CommandResponse command_response(const RecordedRun& run, const RecordedRobot& robot,
                                 const std::vector<std::array<double, 2>>& counts_rad, double step_rad);

/// Speed by which friction slows a wheel whose servo gives way, rad/s. `friction_s`: share c of the robot's weight
/// times the servo's time constant: by c g it is pulled back as an acceleration would.
double slowed_radps(double friction_s, const RecordedRobot& robot);

/// Unit vectors (columns) along the course of a run, its heading at the start, and across it, to the side of its turns:
/// what a driver does along a course is mirrored from cw to ccw, what the world does is not.
Eigen::Matrix2d course_axes(const RecordedRun& run);

/// The recorded counts as angles.
std::vector<std::array<double, 2>> counted_rad(const RecordedRun& run, const RecordedRobot& robot);

}  // namespace umbsim::gap
