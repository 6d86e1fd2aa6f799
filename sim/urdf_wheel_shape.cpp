#include "sim/urdf_wheel_shape.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace umbsim {
namespace {

// A collision cylinder must lie along its joint's axis this closely (a file may say 1.57 for pi/2).
constexpr double kAlong_rad = 0.02;
// A shape off the joint axis by more than this many radii is an eccentric wheel, which is an effect, not a description.
constexpr double kEccentric_radii = 0.01;
// Two shapes whose radii differ by less than this share could both be the wheel.
constexpr double kSameRadius = 0.01;

std::string visual_proposal(const UrdfSource& source, const std::string& link_name) {
  for (const auto& visual : source.model().getLink(link_name)->visual_array) {
    if (const auto* cylinder = dynamic_cast<const urdf::Cylinder*>(visual->geometry.get())) {
      return fmt::format("; its <visual> is a cylinder of radius {:g} m and length {:g} m: copy it into <collision>",
                         cylinder->radius, cylinder->length);
    }
    if (const auto* sphere = dynamic_cast<const urdf::Sphere*>(visual->geometry.get())) {
      return fmt::format("; its <visual> is a sphere of radius {:g} m: copy it into <collision>", sphere->radius);
    }
  }
  return {};
}

std::string no_shape_fault(const UrdfSource& source, const Body& body) {
  const std::string has = body.shapes.empty() ? "has no collision shape" : "its collision is only a mesh or a box";
  return has + "; a wheel needs a <cylinder> or <sphere> as its <collision>" + visual_proposal(source, body.link);
}

bool is_round(const Shape& shape) { return shape.kind == Shape::Kind::sphere || shape.kind == Shape::Kind::cylinder; }

double tilt_rad(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), std::abs(a.dot(b)));
}

}  // namespace

bool is_horizontal(const Eigen::Vector3d& axis) { return std::abs(axis.z()) < std::sin(kLevelTolerance_rad); }

bool is_vertical(const Eigen::Vector3d& axis) { return axis.head<2>().norm() < std::sin(kLevelTolerance_rad); }

WheelShape wheel_shape(const UrdfSource& source, const std::vector<Body>& bodies, int index) {
  const Body& body = bodies[index];
  std::vector<Shape> round;
  std::copy_if(body.shapes.begin(), body.shapes.end(), std::back_inserter(round), is_round);
  if (round.empty()) return {{}, no_shape_fault(source, body)};
  std::sort(round.begin(), round.end(), [](const Shape& a, const Shape& b) { return a.radius_m > b.radius_m; });
  const Shape& shape = round.front();
  if (round.size() > 1 && round[1].radius_m > shape.radius_m * (1 - kSameRadius)) {
    return {{}, fmt::format("two collision shapes of radius {:g} m could be the wheel; leave one", shape.radius_m)};
  }
  if (shape.kind == Shape::Kind::cylinder) {
    const double tilt = tilt_rad(shape.pose.linear().col(2), body.axis);
    if (tilt > kAlong_rad) {
      return {{},
              fmt::format("its collision cylinder lies {:.3g} rad across the joint axis (at most {:g}); check the "
                          "rpy of the collision origin",
                          tilt, kAlong_rad)};
    }
  }
  const Eigen::Vector3d to_centre = shape.centre_m() - body.origin_m;
  const Eigen::Vector3d off_axis = to_centre - to_centre.dot(body.axis) * body.axis;
  if (off_axis.norm() > kEccentric_radii * shape.radius_m) {
    return {{},
            fmt::format("its collision shape is {:.3g} m off the joint axis (at most {:g} of the radius)",
                        off_axis.norm(), kEccentric_radii)};
  }
  const double width = shape.kind == Shape::Kind::cylinder ? shape.length_m : 0;
  return {{index, shape.centre_m() - off_axis, shape.radius_m, width}, {}};
}

}  // namespace umbsim
