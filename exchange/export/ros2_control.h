#pragma once

#include <string>

#include "exchange/export/result.h"

namespace umbsim::exchange {

/// The parameter file of ros2_controllers' diff_drive_controller. `left_joint`, `right_joint`: may be empty. Throws
/// InputError if the result holds no calibration.
std::string ros2_control_yaml(const Result& result, const std::string& left_joint, const std::string& right_joint);

}  // namespace umbsim::exchange
