#pragma once

#include <string>

namespace umbsim::second_engine {

/// MuJoCo's settings. The defaults reproduce what shared/recordings/second-engine shows on the same robot:
///   pose ahead of the counts in proportion to speed    15.6 ms there, 15.6 ms here, loaded or not
///   slippery floor 0.08: heading left out by a square  2.5 to 3.0 degrees there, 2.9 to 3.4 here; loaded none in both
///   right toe 0.006: yaw in a square                   4.1 to 4.9 there, 3.7 to 6.2 here
///   push of 22 N s: heading                            99 mrad there, 109 here
/// All but the push come from the implicit integrator: contacts are solved as if the wheels were free of their servos.
/// The lead is contact_time / 2 * step * servo / wheel inertia. Contacts of 0.002 s slip less, steps of 2 ms or
/// pyramidal cones yaw two to four times as much; impratio 10 to 10000 does the same. With integrator Euler and an
/// armature of 0.1 kg m2 all three are gone.
struct EngineOptions {
  double step_s = 0.001;
  std::string integrator = "implicit";  ///< Euler | implicit
  std::string cone = "elliptic";        ///< pyramidal | elliptic
  std::string wheel = "sphere";         ///< sphere | ellipsoid | cylinder
  double impratio = 10;                 ///< stiffness of friction over that of the normal
  double impedance = 0.99;              ///< solimp's first number; the second is half way from it to 1
  double contact_time_s = 0.004;        ///< solref's time constant
  double contact_damping_ratio = 1;
  double servo_nms = 22;      ///< torque per speed error, of the LabMate's motors; others scale with torque and radius
  double armature_kgm2 = 0;   ///< reflected inertia of its motors, scaled alike
  double clock_offset_s = 0;  ///< the pose is read that much later than the counts of the same time
};

}  // namespace umbsim::second_engine
