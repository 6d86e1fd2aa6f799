#pragma once

#include <array>

namespace umbsim {

/// What stands between a wheel-speed command and one wheel. Nominal: a speed-controlled motor that follows its
/// set-point exactly within its torque limit; the set-point ramps from one command to the next over one control period.
struct Motor {
  double torque_limit_nm = 20;    ///< at the wheel; 0: the wheel runs free
  double gain = 1;                ///< speed over commanded speed
  double lag_s = 0;               ///< time constant of a first-order lag
  double droop_radps_per_nm = 0;  ///< speed that it gives way under a torque; 0: control with an integral part holds it
  double deadband_radps = 0;      ///< commands below this do not move it
  double backlash_rad = 0;        ///< dead zone between motor and wheel; the encoder sits on the motor's side
};

struct Drivetrain {
  std::array<Motor, 2> motor;  ///< left, right

  Drivetrain() = default;
  Drivetrain(double torque_limit_nm) {
    for (Motor& m : motor) m.torque_limit_nm = torque_limit_nm;
  }
};

}  // namespace umbsim
