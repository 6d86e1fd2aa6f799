#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "sim/model/robot_model.h"
#include "sim/urdf/bodies.h"
#include "sim/urdf/source.h"

namespace umbsim {

/// A joint axis this close to the horizontal (or the vertical) counts as such.
inline constexpr double kLevelTolerance_rad = 0.1;
/// A shape whose lowest point is this close to the floor plane, in wheel radii, stands on it.
inline constexpr double kFloorTolerance_radii = 0.1;

bool is_horizontal(const Eigen::Vector3d& axis);
bool is_vertical(const Eigen::Vector3d& axis);

/// A wheel that rolls about its body's joint, in the frame of the body list.
struct RollingWheel {
  int body = -1;
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();  ///< on the joint axis
  double radius_m = 0;
  double width_m = 0;        ///< 0 for a sphere
  std::string taken_from{};  ///< what stands in the place of a collision shape; empty: nothing
  double lowest_m() const { return centre_m.z() - radius_m; }
};

/// `bodies[body]` as a wheel: of `size` where it has a radius, else its collision cylinder or sphere, else what bounds
/// the mesh of its collision about the joint axis, else the same of its visual. If nothing can roll about the joint,
/// `fault` says why and what to do.
struct WheelShape {
  RollingWheel wheel;
  std::string fault;
};
WheelShape wheel_shape(const UrdfSource& source, const std::vector<Body>& bodies, int body, const WheelSize& size = {});

}  // namespace umbsim
