#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>

#include "sim/dynamics/contacts_before.h"
#include "sim/world.h"

namespace umbsim {

/// What a world carries from one moment to the next. `joint_rad`, `velocity`: as many as the robot has
/// (sim/dynamics/multibody.h), zero beyond.
struct Snapshot {
  Eigen::Quaterniond q_WB = Eigen::Quaterniond::Identity();
  Eigen::Vector3d p_WB_m = Eigen::Vector3d::Zero();
  std::array<double, 16> joint_rad{};
  std::array<double, 16> velocity{};  ///< base frame: rad/s, m/s, and rad/s of the joints
  std::array<double, 2> command_radps{};
  std::array<double, 2> set_point_radps{};
  std::array<double, 2> shaft_rad{};
  std::array<double, 2> zero_angle_rad{};
  std::array<double, 2> radius_factor{1, 1};
  std::array<double, 2> rest_load_n{};
  std::array<double, 8> spring_up_m{};  ///< of the supports
  SupportLoads loads;
  double time_s = 0;
  double last_step_s = 0;
  double heading_rad = 0;
  ContactsBefore contacts;
};

/// Whether a robot goes on from both moments in the same way, seen from itself, on a floor that is the same everywhere:
/// to 1e-8 rad, rad/s and m/s, and 1e-4 N.
bool goes_on_alike(const Snapshot& a, const Snapshot& b);

}  // namespace umbsim
