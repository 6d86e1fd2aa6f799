#pragma once

#include <vector>

#include "sim/model/robot_model.h"
#include "sim/urdf/bodies.h"
#include "sim/urdf/source.h"

namespace umbsim {

/// A caster and the bodies that stay bodies of their own; -1 where its mass belongs to the base or fork.
struct FoundSupport {
  Caster caster;  ///< geometry; masses are filled in by load_robot
  int fork = -1;
  int wheel = -1;
  std::vector<int> twins;  ///< wheels beside `wheel`, on the same axle
  int body = -1;           ///< that it belongs to
};

/// The prismatic upright joint that `bodies[index]` or one that carries it moves on.
Slide slide_above(const UrdfSource& source, const std::vector<Body>& bodies, int index);

/// What carries the robot besides the drive wheels, whose bodies are given. `bodies` are in the base frame, the floor
/// is z = -wheel_radius_m; within 10 % of the wheel radius a shape stands on it. Geometry is kept as the file gives it.
/// - Fixed sphere: a ball. Fixed box or cylinder no longer than a drive wheel's diameter: a ball under its middle that
///   touches at the shape's lowest height.
/// - Behind a continuous upright joint: a wheel on a horizontal continuous joint, or a cylinder or sphere of the fork
///   itself, swivels. A sphere centred on the swivel axis is a ball.
/// Where these give no third support off the axle, the first of these does, with a remark: a visual ball on the floor,
/// a collision ball that reaches it if the robot leans by at most 3 degrees, a mesh of a fixed link called caster.
/// Throws InputError: another shape on the floor behind a swivel, or no third support off the axle ("falls over").
std::vector<FoundSupport> find_supports(const UrdfSource& source, const std::vector<Body>& bodies,
                                        const std::vector<int>& drive_bodies, double wheel_radius_m);

}  // namespace umbsim
