#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "sim/robot_model.h"
#include "sim/urdf_source.h"

namespace umbsim {

/// A collision shape, posed in the frame of the body list that holds it.
struct Shape {
  enum class Kind { sphere, cylinder, box, mesh };
  Kind kind = Kind::mesh;
  std::string link;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  double radius_m = 0;                               ///< sphere, cylinder
  double length_m = 0;                               ///< cylinder, along its z
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();  ///< box

  Eigen::Vector3d centre_m() const { return pose.translation(); }
  /// Half the extent along each axis of the list's frame; zero for a mesh.
  Eigen::Vector3d half_extent_m() const;
  double lowest_m() const { return centre_m().z() - half_extent_m().z(); }
};

/// What moves as one: a link behind a moving joint together with everything fixed to it. The first body of a list
/// holds the root link; parents come before children.
struct Body {
  std::string link;   ///< the one behind the joint
  std::string joint;  ///< empty for the root
  bool continuous = false;
  int parent = -1;
  Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();  ///< a point on the joint axis
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  double effort_limit_nm = 0;  ///< 0 if the URDF gives none
  Inertial inertial;
  std::vector<Shape> shapes;
};

/// The bodies at joint position zero in the root link's frame. Checks every mass and inertia: throws InputError for a
/// negative mass, an impossible inertia, a massless body behind a moving joint, a shape without size.
/// A fixed link may be massless (a frame, a shell) or, below 5 % of the robot's mass, a point without inertia.
std::vector<Body> read_bodies(const UrdfSource& source);

/// The same list in frame A, `x_ar` being the pose of the present frame in A.
std::vector<Body> in_frame(std::vector<Body> bodies, const Eigen::Isometry3d& x_ar);

/// For each body the one that carries its mass: itself if `separate`, otherwise the nearest separate ancestor.
std::vector<int> mass_owners(const std::vector<Body>& bodies, const std::vector<bool>& separate);

/// Mass of every owner; zero elsewhere.
std::vector<Inertial> lump_by_owner(const std::vector<Body>& bodies, const std::vector<int>& owners);

}  // namespace umbsim
