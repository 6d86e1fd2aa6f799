#pragma once

#include <optional>
#include <vector>

#include "calibration/methods/fit.h"

namespace umbsim::calibration {

/// Squares as they count in UMBmark's mean.
struct SquareCourse {
  double side_m = 0;
  double turn_radius_m = 0;  ///< 0: turns in place
  double weight = 0;
  int laps = 1;
};

/// What UMBmark's endpoint form, small angles and all, says of a robot with these true factors whose odometry is sure to
/// drive exact squares: pure kinematics, no noise.
LogFactors endpoint_answer(const std::vector<SquareCourse>& courses, const OdometryParameters& nominal,
                           const LogFactors& truth);

/// The form's own bias behind an answer: answer minus the robot that would give it. None where no robot is found.
std::optional<LogFactors> own_bias(const std::vector<SquareCourse>& courses, const OdometryParameters& nominal,
                                   const LogFactors& answer);

}  // namespace umbsim::calibration
