#pragma once

#include <string>

#include "odometry/dead_reckoning.h"
#include "sim/model/robot_model.h"

namespace umbsim::exchange {

/// The URDF with both drive wheels' radii and their distance as in `odometry`: the wheels' cylinders and spheres are
/// scaled, the joints moved along the axle. `model`: what load_robot read from `file`. Throws InputError where the
/// file's wheels cannot be changed so (meshes alone, shapes that no plain scale changes).
std::string calibrated_urdf(const std::string& file, const RobotModel& model, const OdometryParameters& odometry);

/// What the wheels' contacts have.
struct WheelContact {
  double friction = 0.9;
  double slip_along = 0, slip_across = 0;  ///< m/s per newton
};

/// An SDF snippet for Gazebo: its DiffDrive plugin, and the surface of the wheels.
std::string diff_drive_sdf(const RobotModel& model, const OdometryParameters& odometry, const WheelContact& contact,
                           const std::string& provenance);

}  // namespace umbsim::exchange
