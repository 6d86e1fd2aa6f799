#include "sim/urdf/wheel_shape.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/mesh/mesh_points.h"

namespace umbsim {
namespace {

// A collision cylinder must lie along its joint's axis this closely (a file may say 1.57 for pi/2).
constexpr double kAlong_rad = 0.02;
// A shape off the joint axis by more than this many radii is an eccentric wheel, which is an effect, not a description.
constexpr double kEccentric_radii = 0.01;
// A mesh is round about the axis if it reaches this close to its radius on four sides.
constexpr double kRoundMesh = 0.05;
// A wheel whose width nobody gives.
constexpr double kUsualWidth_radii = 0.4;
// Two shapes whose radii differ by less than this share could both be the wheel.
constexpr double kSameRadius = 0.01;

bool is_round(const Shape& shape) { return shape.kind == Shape::Kind::sphere || shape.kind == Shape::Kind::cylinder; }

double tilt_rad(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), std::abs(a.dot(b)));
}

}  // namespace

bool is_horizontal(const Eigen::Vector3d& axis) { return std::abs(axis.z()) < std::sin(kLevelTolerance_rad); }

bool is_vertical(const Eigen::Vector3d& axis) { return axis.head<2>().norm() < std::sin(kLevelTolerance_rad); }

namespace {

// Tyres beside each other, or one shape given twice: the cylinder that holds them. Fault if they are not coaxial.
WheelShape of_tyres(const Body& body, int index, const std::vector<Shape>& tyres) {
  double low_m = 1e9, high_m = -1e9;
  for (const Shape& tyre : tyres) {
    const Eigen::Vector3d at = tyre.centre_m() - body.origin_m;
    const double along_m = at.dot(body.axis);
    const double half_m = tyre.kind == Shape::Kind::cylinder ? tyre.length_m / 2 : 0;
    const bool aside = (at - along_m * body.axis).norm() > kEccentric_radii * tyre.radius_m;
    if (aside || (half_m > 0 && tilt_rad(tyre.pose.linear().col(2), body.axis) > kAlong_rad)) {
      return {
          {},
          fmt::format("two collision shapes of radius {:g} m could be the wheel, and are not on one axis; leave one",
                      tyres[0].radius_m)};
    }
    low_m = std::min(low_m, along_m - half_m);
    high_m = std::max(high_m, along_m + half_m);
  }
  return {{index, body.origin_m + (low_m + high_m) / 2 * body.axis, tyres[0].radius_m, high_m - low_m,
           fmt::format("its {} coaxial shapes", tyres.size())},
          {}};
}

WheelShape of_primitives(const Body& body, int index, const std::vector<Shape>& shapes) {
  std::vector<Shape> round;
  std::copy_if(shapes.begin(), shapes.end(), std::back_inserter(round), is_round);
  std::sort(round.begin(), round.end(), [](const Shape& a, const Shape& b) { return a.radius_m > b.radius_m; });
  const Shape& shape = round.front();
  const auto tyres = std::count_if(round.begin(), round.end(), [&](const Shape& other) {
    return other.radius_m > shape.radius_m * (1 - kSameRadius);
  });
  if (tyres > 1) return of_tyres(body, index, {round.begin(), round.begin() + tyres});
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

// The cylinder about the joint axis that holds the mesh.
WheelShape bounding_wheel(const UrdfSource& source, const Body& body, int index, const Shape& shape) {
  const std::vector<Eigen::Vector3d> points = mesh_points(source.file(), shape.mesh);
  if (points.empty()) return {{}, fmt::format("its mesh '{}' is not found or cannot be read", shape.mesh.name)};
  const Eigen::Vector3d side = body.axis.unitOrthogonal();
  Eigen::Matrix3d to_wheel;
  to_wheel << side.transpose(), body.axis.cross(side).transpose(), body.axis.transpose();
  Eigen::Vector3d low = Eigen::Vector3d::Constant(1e9), high = -low;
  double radius_m = 0;
  for (const Eigen::Vector3d& p : points) {
    const Eigen::Vector3d at = to_wheel * (shape.pose * p - body.origin_m);
    low = low.cwiseMin(at);
    high = high.cwiseMax(at);
    radius_m = std::max(radius_m, at.head<2>().norm());
  }
  const Eigen::Vector3d reach = low.cwiseAbs().cwiseMin(high.cwiseAbs());
  if (!(reach.head<2>().minCoeff() > (1 - kRoundMesh) * radius_m)) {
    return {{}, fmt::format("its mesh '{}' is not round about the joint axis", shape.mesh.name)};
  }
  const double middle_m = (low.z() + high.z()) / 2, width_m = high.z() - low.z();
  return {{index, body.origin_m + middle_m * body.axis, radius_m, width_m,
           fmt::format("what bounds its mesh '{}'", shape.mesh.name)},
          {}};
}

// The first mesh that bounds a wheel, else the first fault.
WheelShape of_meshes(const UrdfSource& source, const Body& body, int index, const std::vector<Shape>& shapes) {
  WheelShape result;
  result.fault = "has no collision shape";
  bool first = true;
  for (const Shape& shape : shapes) {
    if (shape.kind != Shape::Kind::mesh) continue;
    WheelShape found = bounding_wheel(source, body, index, shape);
    if (found.fault.empty()) return found;
    if (std::exchange(first, false)) result.fault = "its collision is only a mesh, and " + found.fault;
  }
  return result;
}

bool any_round(const std::vector<Shape>& shapes) { return std::any_of(shapes.begin(), shapes.end(), is_round); }

WheelShape from_urdf(const UrdfSource& source, const Body& body, int index) {
  if (any_round(body.shapes)) return of_primitives(body, index, body.shapes);
  const WheelShape collision = of_meshes(source, body, index, body.shapes);
  if (collision.fault.empty()) return collision;
  WheelShape visual =
      any_round(body.visuals) ? of_primitives(body, index, body.visuals) : of_meshes(source, body, index, body.visuals);
  if (visual.fault.empty()) {
    if (visual.wheel.taken_from.empty()) visual.wheel.taken_from = "its visual cylinder or sphere";
    return visual;
  }
  std::string fault = body.shapes.empty() || collision.fault.find("mesh") != std::string::npos
                          ? collision.fault
                          : "its collision is only a box";
  for (const Flaw& flaw : body.flaws) {
    if (!flaw.of_inertia) fault = flaw.what;
  }
  return {{},
          fault +
              "; a wheel needs a <cylinder> or <sphere> as its <collision>, or give its size: --wheel-radius and "
              "--wheel-width, robot.wheel_radius_m and robot.wheel_width_m in a scenario"};
}

}  // namespace

WheelShape wheel_shape(const UrdfSource& source, const std::vector<Body>& bodies, int index, const WheelSize& size) {
  const Body& body = bodies[index];
  WheelShape found = from_urdf(source, body, index);
  if (size.radius_m == 0 && size.width_m == 0) return found;
  if (size.radius_m == 0 && !found.fault.empty()) return found;
  if (!found.fault.empty()) found.wheel = {index, body.origin_m, 0, 0};
  found.fault.clear();
  if (size.radius_m > 0) found.wheel.radius_m = size.radius_m;
  if (size.width_m > 0) found.wheel.width_m = size.width_m;
  found.wheel.taken_from = "the given size";
  if (found.wheel.width_m > 0) return found;
  found.wheel.width_m = kUsualWidth_radii * found.wheel.radius_m;
  found.wheel.taken_from = fmt::format("the given radius; a width of {:g} radii is assumed", kUsualWidth_radii);
  return found;
}

}  // namespace umbsim
