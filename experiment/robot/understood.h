#pragma once

#include <string>
#include <vector>

#include "experiment/scenario/scenario.h"

namespace umbsim {

/// Largest acceleration forwards, backwards (which is braking), m/s2, and turning on the spot, rad/s2. Infinite: none
/// does it.
struct AccelerationLimits {
  double forward_mps2 = 0;
  double backward_mps2 = 0;
  double turning_radps2 = 0;
};

/// What the program makes of a robot's URDF.
struct UnderstoodRobot {
  RobotModel robot;
  std::vector<Remark> remarks;
  Inertial body;                   ///< all of it, base frame
  std::vector<double> loads_n;     ///< left wheel, right wheel, casters: settled on a flat floor
  AccelerationLimits tips;         ///< by the balance of moments, all supports loaded
  AccelerationLimits slips;        ///< by the friction of both wheels, with the shift of load
  double friction = 0;             ///< of the floor
  std::vector<std::string> wrong;  ///< what will not go well, and what helps
};

/// Reads the robot of the scenario and lets it settle on its floor's friction, flat. Throws InputError if it cannot be
/// driven at all.
UnderstoodRobot understand_robot(const Scenario& scenario);

/// For a terminal.
std::string understood_text(const UnderstoodRobot& robot);

/// Top and side view with supports, centre of mass and loads, as an SVG picture.
std::string robot_picture(const UnderstoodRobot& robot);

}  // namespace umbsim
