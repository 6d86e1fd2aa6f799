#include "bench/worlds/engines/planar/drive.h"

#include <algorithm>
#include <cmath>

namespace umbsim::worlds::planar {

Drive::Drive(const Motor& motor, const Servo& servo, double wheel_kgm2)
    : motor_(motor), servo_(servo), wheel_kgm2_(wheel_kgm2) {}

// Speed of an inertia under the motor and a load after the step; implicit in the control's gain.
double Drive::turn(double inertia_kgm2, double speed_radps, double load_nm, double step_s) {
  const double gain = servo_.gain_nms, limit_nm = motor_.torque_limit_nm;
  const double speed = (inertia_kgm2 * speed_radps + step_s * (gain * set_point_radps_ + integral_nm_ - load_nm)) /
                       (inertia_kgm2 + step_s * gain);
  const double wanted_nm = gain * (set_point_radps_ - speed) + integral_nm_;
  motor_nm_ = std::clamp(wanted_nm, -limit_nm, limit_nm);
  if (motor_nm_ != wanted_nm) return speed_radps + step_s * (motor_nm_ - load_nm) / inertia_kgm2;
  integral_nm_ += step_s * gain / servo_.integral_time_s * (set_point_radps_ - speed);
  return speed;
}

void Drive::step(double set_point_radps, double floor_nm, double step_s) {
  set_point_radps_ = set_point_radps;
  const double shaft_before = shaft_radps_, wheel_before = wheel_radps_;
  const double together_kgm2 = servo_.rotor_kgm2 + wheel_kgm2_;
  if (motor_.backlash_rad == 0) {
    shaft_radps_ = wheel_radps_ = turn(together_kgm2, wheel_radps_, floor_nm, step_s);
  } else if (side_ != 0) {
    shaft_radps_ = wheel_radps_ = turn(together_kgm2, wheel_radps_, floor_nm, step_s);
    const double passed_nm = wheel_kgm2_ * (wheel_radps_ - wheel_before) / step_s + floor_nm;
    if (passed_nm * side_ < 0) side_ = 0;
  } else {
    shaft_radps_ = turn(servo_.rotor_kgm2, shaft_radps_, 0, step_s);
    wheel_radps_ -= step_s * floor_nm / wheel_kgm2_;
  }
  shaft_rad_ += step_s * (shaft_before + shaft_radps_) / 2;
  wheel_rad_ += step_s * (wheel_before + wheel_radps_) / 2;
  if (motor_.backlash_rad > 0 && side_ == 0) meet();
}

// At the end of the play both go on with their common momentum.
void Drive::meet() {
  const double half_rad = motor_.backlash_rad / 2, gap_rad = shaft_rad_ - wheel_rad_;
  if (std::abs(gap_rad) < half_rad) return;
  side_ = gap_rad > 0 ? 1 : -1;
  wheel_rad_ = shaft_rad_ - side_ * half_rad;
  const double momentum = servo_.rotor_kgm2 * shaft_radps_ + wheel_kgm2_ * wheel_radps_;
  shaft_radps_ = wheel_radps_ = momentum / (servo_.rotor_kgm2 + wheel_kgm2_);
}

}  // namespace umbsim::worlds::planar
