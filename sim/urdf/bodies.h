#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "sim/mesh/mesh_points.h"
#include "sim/model/robot_model.h"
#include "sim/urdf/source.h"

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
  MeshFile mesh;

  Eigen::Vector3d centre_m() const { return pose.translation(); }
  /// Half the extent along each axis of the list's frame; zero for a mesh.
  Eigen::Vector3d half_extent_m() const;
  double smallest_m() const;  ///< size; of a mesh its scale
  double lowest_m() const { return centre_m().z() - half_extent_m().z(); }
};

/// What is wrong with a link, or missing. It matters if the link drives.
struct Flaw {
  std::string link;
  std::string what;
  bool of_inertia = false;
};

/// What moves as one: a link behind a moving joint together with everything fixed to it. The first body of a list
/// holds the root link; parents come before children.
struct Body {
  std::string link;         ///< the one behind the joint
  std::string joint;        ///< empty for the root
  bool continuous = false;  ///< turns for ever, or as good as
  bool revolute = false;    ///< by its type, even if it turns for ever
  bool prismatic = false;
  int parent = -1;
  Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();  ///< a point on the joint axis
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  double effort_limit_nm = 0;   ///< 0 if the URDF gives none
  double lower = 0, upper = 0;  ///< of the joint's position
  Inertial inertial;
  std::vector<Shape> shapes;  ///< of collisions
  std::vector<Shape> visuals;
  std::vector<Flaw> flaws;
};

/// The bodies at joint position zero in the root link's frame. Throws InputError for a negative mass, and for an
/// impossible or missing inertia of a link that weighs more than 5 % of the robot. Lighter ones are completed (a
/// uniform box of the link's shapes) and are flaws of their body, as are shapes without size, which are left out. A
/// link may be massless (a frame, a shell).
std::vector<Body> read_bodies(const UrdfSource& source);

Eigen::Isometry3d to_eigen(const urdf::Pose& pose);

/// A shape of `link`, posed by `x_rs`.
Shape make_shape(const std::string& link, const urdf::Geometry& geometry, const Eigen::Isometry3d& x_rs);

/// The same list in frame A, `x_ar` being the pose of the present frame in A.
std::vector<Body> in_frame(std::vector<Body> bodies, const Eigen::Isometry3d& x_ar);

/// For each body the one that carries its mass: itself if `separate`, otherwise the nearest separate ancestor.
std::vector<int> mass_owners(const std::vector<Body>& bodies, const std::vector<bool>& separate);

/// Mass of every owner; zero elsewhere.
std::vector<Inertial> lump_by_owner(const std::vector<Body>& bodies, const std::vector<int>& owners);

}  // namespace umbsim
