#pragma once

namespace umbsim {

/// What stands between a wheel-speed command and the wheel, the same for both wheels.
/// Nominal: a speed-controlled motor that follows its set-point exactly within its torque limit; the set-point ramps
/// from one command to the next over one control period.
struct Drivetrain {
  double torque_limit_nm = 20;  ///< at the wheel; > 0
};

}  // namespace umbsim
