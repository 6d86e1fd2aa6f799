#pragma once

#include <Eigen/Geometry>
#include <string>

#include "sim/model/robot_model.h"

namespace umbsim {

/// The same body expressed in frame A: `x_ab` is the pose of its present frame B in A.
Inertial transformed(const Inertial& body, const Eigen::Isometry3d& x_ab);

/// Both bodies as one rigid body, by the parallel axis theorem. Massless if both are.
Inertial lumped(const Inertial& a, const Inertial& b);

/// What is wrong with an inertia tensor about a centre of mass, or empty if nothing is: not finite, a principal
/// moment that is not positive, or one larger than the sum of the other two (1 % allowed, for rounded files).
std::string inertia_fault(const Eigen::Matrix3d& inertia_kgm2);

}  // namespace umbsim
