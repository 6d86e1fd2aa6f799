#pragma once

#include <string>

#include "sim/model/robot_model.h"

namespace umbsim {

/// A URDF's text with the drive wheels' shapes written into it as collision cylinders in the place of what is there, so
/// that it can be read without its meshes and without a given size. `joints`: of the robot that was read from it, with
/// its wheels. Returns `text` itself where `robot.outside_shapes` is false.
std::string urdf_with_wheels(const std::string& text, const RobotModel& robot);

}  // namespace umbsim
