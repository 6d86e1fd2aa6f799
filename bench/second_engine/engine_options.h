#pragma once

#include <string>

namespace umbsim::second_engine {

/// MuJoCo's settings. The defaults reproduce best what another engine's labelled recordings show: how much a toed wheel
/// yaws (4 to 6 degrees a square) and how much turns fall short on a slippery floor (2.8 degrees). Stiffer contacts
/// (0.002 s) slip a third as much there, steps of 2 ms or pyramidal cones yaw two to four times as much, and default
/// contacts (0.02 s, impedance 0.9) not at all. A velocity servo of this gain is unstable with integrator Euler.
struct EngineOptions {
  double step_s = 0.001;
  std::string integrator = "implicit";  ///< Euler | implicit
  std::string cone = "elliptic";        ///< pyramidal | elliptic
  std::string wheel = "sphere";         ///< sphere | ellipsoid | cylinder
  double impratio = 10;                 ///< how much stiffer friction is than the normal; 10 to 10000 do the same
  double impedance = 0.99;              ///< solimp's first number; the second is half way from it to 1
  double contact_time_s = 0.004;        ///< solref's time constant
  double contact_damping_ratio = 1;
  double servo_nms = 20;  ///< torque per speed error, of the robot of 40 kg; scaled with mass and radius
};

}  // namespace umbsim::second_engine
