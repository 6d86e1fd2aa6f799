#pragma once

#include <Eigen/Core>
#include <vector>

#include "recording/recording.h"

namespace umbsim {

/// How a shaft's counts follow its commands.
struct CountsBehind {
  double lag_s = 0;  ///< time by which they are late
  /// Speed beyond the command along the cosine and the sine of the heading, rad/s: a slope pulls so on motors that give
  /// way. Zero where the course does not tell it from a gain.
  Eigen::Vector2d by_heading_radps = Eigen::Vector2d::Zero();
  double share = 0;           ///< of the commanded angle by which it stays behind on the way,
  double share_in_place = 0;  ///< and in turns in place
};

/// Where a robot heads, at one of its encoder samples.
struct HeadingOverTime {
  /// Cosine and sine of the heading summed over time: as counted, from where the truth begins.
  Eigen::Vector2d ahead_s = Eigen::Vector2d::Zero();
  bool in_place = false;  ///< its wheels are told to turn against each other
};

/// Least squares of how far a shaft is behind its commands on the commanded speed, one, the heading, and the commanded
/// angle on the way and in turns in place, where other friction holds a wheel back. All of a length, by encoder sample.
/// `step_rad`: between two counts.
CountsBehind counts_behind(const std::vector<double>& commanded_radps, const std::vector<double>& commanded_rad,
                           const std::vector<double>& counted_rad, const std::vector<HeadingOverTime>& heading,
                           double step_rad);

/// Of each encoder sample of a run.
std::vector<HeadingOverTime> heading_over_time(const RecordedRun& run, const RecordedRobot& robot);

}  // namespace umbsim
