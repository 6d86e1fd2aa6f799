#pragma once

#include <Eigen/Core>

namespace umbsim::worlds::planar {

/// What of a vector lies in the floor's plane.
inline Eigen::Vector2d flat(const Eigen::Vector3d& v) { return v.head<2>(); }

/// A quarter turn counter-clockwise.
inline Eigen::Vector2d left_of(const Eigen::Vector2d& v) { return {-v.y(), v.x()}; }

/// z of the cross product.
inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

}  // namespace umbsim::worlds::planar
