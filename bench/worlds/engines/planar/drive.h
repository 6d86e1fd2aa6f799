#pragma once

#include "bench/worlds/engines/set_point.h"
#include "sim/model/drivetrain.h"

namespace umbsim::worlds::planar {

/// Gains of a speed control, and what turns with the motor.
struct Servo {
  double gain_nms = 1;
  double integral_time_s = 0.1;
  double rotor_kgm2 = 0;
};

/// A geared motor under speed control, and the wheel that it turns: one inertia, or two with a play between them, whose
/// ends stop without rebound.
class Drive {
 public:
  Drive(const Motor& motor, const Servo& servo, double wheel_kgm2);

  /// `floor_nm`: what the floor holds the wheel back with.
  void step(double set_point_radps, double floor_nm, double step_s);

  double wheel_radps() const { return wheel_radps_; }
  double wheel_rad() const { return wheel_rad_; }
  double shaft_rad() const { return shaft_rad_; }
  /// What turns with the wheel even when the play is open.
  double floor_side_kgm2() const { return motor_.backlash_rad > 0 ? wheel_kgm2_ : wheel_kgm2_ + servo_.rotor_kgm2; }
  double energy_j() const {
    return (servo_.rotor_kgm2 * shaft_radps_ * shaft_radps_ + wheel_kgm2_ * wheel_radps_ * wheel_radps_) / 2;
  }

 private:
  double turn(double inertia_kgm2, double speed_radps, double load_nm, double step_s);
  void meet();

  Motor motor_;
  Servo servo_;
  double wheel_kgm2_;
  double set_point_radps_ = 0;
  double integral_nm_ = 0;
  double motor_nm_ = 0;
  double shaft_radps_ = 0, shaft_rad_ = 0;
  double wheel_radps_ = 0, wheel_rad_ = 0;
  int side_ = 0;  // of the play's end at which motor and wheel turn together; 0: free
};

}  // namespace umbsim::worlds::planar
