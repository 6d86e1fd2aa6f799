#pragma once

#include <string>

#include "bench/fidelity/robots.h"

namespace umbsim::fidelity {

/// A trip whose wheel speeds keep their ratio: one circle, or a straight line, or a turn on the spot.
struct RollingCheck {
  double path_m = 0;      ///< of the axle's middle
  double turned_rad = 0;
  double off_m = 0;       ///< from the circle that the wheel angles say
  double off_rad = 0;
};
RollingCheck roll(const RobotModel& robot, double left_radps, double right_radps, const PhysicsOptions& options);

/// Wheels at an angle to the robot's axis. Skewed: both turned left. Toe-in: the left one to the right and so on.
enum class Skew { toe_in, skewed };
struct ToeCheck {
  double along_m = 0, across_m = 0;  ///< driven
  double expected_along_m = 0, expected_across_m = 0;
  double turned_rad = 0;             ///< expected: 0
};
ToeCheck roll_with_toe(Skew kind, double toe_rad);

/// Left wheel mounted off its centre, both turned alike.
struct EccentricCheck {
  double ripple_rad = 0;           ///< half the range of the heading
  double expected_ripple_rad = 0;  ///< e / b
  double off_rad = 0;              ///< worst difference from the closed form
  double drift_rad = 0;            ///< heading gained per revolution, from the means over the second and last one
};
EccentricCheck roll_eccentric(double eccentricity_m, double step_s);

std::string rolling_chapter(Grid grid);

}  // namespace umbsim::fidelity
