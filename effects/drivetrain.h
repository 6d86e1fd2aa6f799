#pragma once

#include "effects/rig.h"

namespace umbsim {

/// Play between the motor with its encoder and the wheel.
struct Backlash {
  double left_rad = 0;
  double right_rad = 0;
};
void apply(const Backlash& effect, Rig& rig);

/// How far the motors are from following their commands.
struct MotorResponse {
  double lag_s = 0;
  double deadband_radps = 0;
  double gain_asymmetry = 0;   ///< right over left gain is 1 + this, their mean stays
  double torque_limit_nm = 0;  ///< 0: the scenario's
  double droop_radps_per_nm = 0;
};
void apply(const MotorResponse& effect, Rig& rig);

/// Linear and angular accelerations of the course times a factor.
struct OverAcceleration {
  double factor = 1;
};
void apply(const OverAcceleration& effect, Rig& rig);

/// Angular speed of the turns times a factor.
struct FastTurning {
  double factor = 1;
};
void apply(const FastTurning& effect, Rig& rig);

}  // namespace umbsim
