#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace umbsim {

/// A mesh as the URDF names it.
struct MeshFile {
  std::string name;
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();
};

/// Where the file of a URDF's mesh lies: beside the URDF, for package://NAME/PATH in a folder NAME above it or in
/// ROS_PACKAGE_PATH and AMENT_PREFIX_PATH. Empty if it is not found.
std::string find_mesh(const std::string& urdf_file, const std::string& name);

/// The corners of a mesh in the shape's frame, scaled: STL (binary or text), OBJ, or Collada (.dae, with its unit and
/// its scene's transforms). Empty if the file is missing, of another kind, or not readable.
std::vector<Eigen::Vector3d> mesh_points(const std::string& urdf_file, const MeshFile& mesh);

}  // namespace umbsim
