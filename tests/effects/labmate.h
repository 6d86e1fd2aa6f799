#pragma once

namespace umbsim::testing {

/// The nominal LabMate's wheels, and those of the robot of round numbers.
constexpr double kRadius_m = 0.075, kWheelbase_m = 0.340;

/// Slip over traction, where wheels creep in a test.
constexpr double kCreep = 0.02;

}  // namespace umbsim::testing
