#include "effects/drivetrain.h"

namespace umbsim {

void apply(const Backlash& effect, Rig& rig) {
  rig.drivetrain.motor[0].backlash_rad = effect.left_rad;
  rig.drivetrain.motor[1].backlash_rad = effect.right_rad;
}

void apply(const MotorResponse& effect, Rig& rig) {
  auto& motor = rig.drivetrain.motor;
  for (Motor& m : motor) {
    m.lag_s = effect.lag_s;
    m.deadband_radps = effect.deadband_radps;
    m.droop_radps_per_nm = effect.droop_radps_per_nm;
    if (effect.torque_limit_nm > 0) m.torque_limit_nm = effect.torque_limit_nm;
  }
  motor[0].gain = 2 / (2 + effect.gain_asymmetry);
  motor[1].gain = 2 * (1 + effect.gain_asymmetry) / (2 + effect.gain_asymmetry);
}

void apply(const OverAcceleration& effect, Rig& rig) { rig.commanded_motion.acceleration_factor = effect.factor; }

void apply(const FastTurning& effect, Rig& rig) { rig.commanded_motion.turn_speed_factor = effect.factor; }

}  // namespace umbsim
