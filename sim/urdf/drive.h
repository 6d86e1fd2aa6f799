#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "sim/model/robot_model.h"
#include "sim/urdf/bodies.h"
#include "sim/urdf/source.h"
#include "sim/urdf/wheel_shape.h"

namespace umbsim {

/// The two driven wheels, in the root link's frame.
struct Drive {
  std::array<RollingWheel, 2> wheels;  ///< left, right

  /// Pose of the root link in the robot's base frame: origin between the wheel centres, y from right to left centre.
  Eigen::Isometry3d root_in_base() const;
};

/// Finds the drive wheels as load_robot says. Both joint axes are then taken as the line between the wheel centres:
/// a nominal description has no toe and no camber, and 1.57 for pi/2 is not one.
Drive find_drive(const UrdfSource& source, const std::vector<Body>& bodies, const DriveJoints& joints,
                 const WheelSize& size = {});

}  // namespace umbsim
