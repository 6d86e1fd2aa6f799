#pragma once

#include <cmath>

#include "core/error.h"
#include "sim/model/drivetrain.h"

namespace umbsim::worlds {

/// The set-point that one motor's speed control is given: the commanded speed behind the motor's gain, deadband and
/// first-order lag. For engines that have no motors of their own; sim/step.cpp does the same.
class SetPoint {
 public:
  /// Throws InputError for droop: these engines' motors give way by their own servos' options alone.
  explicit SetPoint(const Motor& motor) : motor_(motor) {
    if (motor.droop_radps_per_nm > 0)
      throw InputError(
          "effects.motor_response.droop_radps_per_nm: only the engine ours has it (must be 0 in bullet, mujoco and "
          "planar, whose servos give way by their options)");
  }

  /// The command is going in a straight line to `command_radps`; `part` of the way is behind it after this step.
  double step(double command_radps, double part, double step_s) {
    double wanted = motor_.gain * ((1 - part) * last_command_radps_ + part * command_radps);
    if (std::abs(wanted) < motor_.deadband_radps) wanted = 0;
    const double follow = motor_.lag_s > 0 ? 1 - std::exp(-step_s / motor_.lag_s) : 1;
    const double mean_radps = wanted + (radps_ - wanted) * follow * motor_.lag_s / step_s;
    radps_ += follow * (wanted - radps_);
    return mean_radps;
  }
  /// The command has arrived: the next line starts there.
  void arrive(double command_radps) { last_command_radps_ = command_radps; }

 private:
  Motor motor_;
  double last_command_radps_ = 0;
  double radps_ = 0;
};

}  // namespace umbsim::worlds
