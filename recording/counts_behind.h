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
};

/// Least squares of how far a shaft is behind its commands on the commanded speed, angle and way, one, and the heading.
/// All of a length, by encoder sample. `ahead_s`: cosine and sine of the heading over time, as heading_over_time()
/// gives them. `step_rad`: between two counts.
CountsBehind counts_behind(const std::vector<double>& commanded_radps, const std::vector<double>& commanded_rad,
                           const std::vector<double>& counted_rad, const std::vector<Eigen::Vector2d>& ahead_s,
                           double step_rad);

/// Cosine and sine of a run's heading summed over time, at its encoder samples: as counted, from where the truth
/// begins.
std::vector<Eigen::Vector2d> heading_over_time(const RecordedRun& run, const RecordedRobot& robot);

}  // namespace umbsim
