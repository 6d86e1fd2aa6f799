#include "sim/model/floor.h"

#include <Eigen/Geometry>
#include <cmath>
#include <optional>

#include "core/random.h"
#include "sim/model/floor_near.h"

namespace umbsim {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kNewtonSteps = 8;
constexpr double kConverged = 1e-13;
constexpr double kNearlyThere = 1e-10;  // of a slope: the next step ends below round-off
constexpr double kLeastDeterminant = 0.25;

// The direction in the disc's plane that points most nearly along `towards`.
Vector3d in_plane(const Vector3d& axis, const Vector3d& towards) {
  return (towards - axis * axis.dot(towards)).normalized();
}

// Newton's change of a slope that is `off` from that of the floor at the rim's point for it: the rim's point moves by
// the radius times the change, in the disc's plane, and the floor's slope there by its bend. None where the floor bends
// nearly as much as the wheel.
std::optional<Vector2d> newton_change(const FloorBend& floor, const RollingShape& shape, const Vector2d& off) {
  const Vector2d axis = shape.axis.head<2>();
  Matrix2d bend, left = Matrix2d::Identity();
  bend << floor.xx_per_m, floor.xy_per_m, floor.xy_per_m, floor.yy_per_m;
  left -= shape.radius_m * (bend - (bend * axis) * axis.transpose());
  const double determinant = left(0, 0) * left(1, 1) - left(0, 1) * left(1, 0);
  if (determinant < kLeastDeterminant) return std::nullopt;
  return Vector2d(left(1, 1) * off.x() - left(0, 1) * off.y(), left(0, 0) * off.y() - left(1, 0) * off.x()) /
         determinant;
}

}  // namespace

double friction_at(const Floor& floor, double x_m, double y_m) {
  double friction = floor.friction;
  for (const FrictionPatch& p : floor.patches) {
    if (std::hypot(x_m - p.x_m, y_m - p.y_m) < p.radius_m) friction = p.friction;
  }
  return friction;
}

FloorPoint floor_at(const Floor& floor, double x_m, double y_m) { return floor_bend(floor, x_m, y_m).at; }

std::vector<Ripple> random_ripples(double rms_m, double wavelength_m, std::uint64_t seed, std::uint64_t index,
                                   int waves) {
  std::vector<Ripple> ripples;
  if (rms_m == 0) return ripples;
  RandomStream random(seed, "floor ripples", index);
  const double amplitude_m = rms_m * std::sqrt(2.0 / waves);  // mean square of one cosine is a^2 / 2
  for (int i = 0; i < waves; ++i) {
    const double k = 2 * M_PI / (wavelength_m * random.uniform(2.0 / 3, 4.0 / 3));
    const double direction = random.uniform(-M_PI, M_PI);
    ripples.push_back({amplitude_m, k * std::cos(direction), k * std::sin(direction), random.uniform(-M_PI, M_PI)});
  }
  return ripples;
}

// The nearest point of disc or ball lies where its own normal opposes the floor's: the floor's slope there is `slope`.
// Newton's method, which takes the disc for upright, or else the fixed-point iteration.
NearestPoint nearest_on_floor(const Floor& floor, const RollingShape& shape) {
  const bool ball = shape.axis.isZero();
  Vector2d slope = Vector2d::Zero();
  Vector3d normal = Vector3d::UnitZ(), rim;
  const auto go_to_rim = [&] {
    rim = shape.centre_m + shape.radius_m * (ball ? Vector3d(-normal) : in_plane(shape.axis, -normal));
  };
  go_to_rim();
  if (floor.ripples.empty()) return {{rim.x(), rim.y(), 0}, normal, rim.z()};
  FloorNear near(floor, rim.x(), rim.y());
  for (int i = 0;; ++i) {
    const FloorBend found = near.at(rim.x(), rim.y());
    const Vector2d off = Vector2d(found.at.slope_x, found.at.slope_y) - slope;
    const std::optional<Vector2d> change = newton_change(found, shape, off);
    slope += change.value_or(off);
    normal = Vector3d(-slope.x(), -slope.y(), 1).normalized();
    const double near_enough = change ? kNearlyThere : kConverged;
    if (off.squaredNorm() < near_enough * near_enough || i == 4 * kNewtonSteps) {
      const double height_m = found.at.height_m;
      return {{rim.x(), rim.y(), height_m}, normal, (rim.z() - height_m) * normal.z()};
    }
    go_to_rim();
  }
}

bool nearest_on_cable(const Floor& floor, const Cable& cable, const RollingShape& shape, NearestPoint& nearest) {
  const double radius_m = cable.height_m / 2;
  const Vector3d along(std::cos(cable.direction_rad), std::sin(cable.direction_rad), 0);
  const double ground_m = floor.ripples.empty() ? 0 : floor_at(floor, cable.x_m, cable.y_m).height_m;
  const Vector3d middle(cable.x_m, cable.y_m, ground_m + radius_m);
  const auto across = [&](const Vector3d& p) { return Vector3d((p - middle) - along * along.dot(p - middle)); };

  Vector3d rim = shape.centre_m;
  Vector3d gap = across(rim);
  if (shape.axis.isZero()) {
    rim -= shape.radius_m * gap.normalized();
  } else {
    // Newton on the rim angle that makes the squared distance to the cable's axis stationary.
    const Vector3d u = in_plane(shape.axis, -gap);
    const Vector3d w = shape.axis.cross(u);
    double angle = 0;
    for (int i = 0; i < kNewtonSteps; ++i) {
      const Vector3d p = shape.radius_m * (std::cos(angle) * u + std::sin(angle) * w);
      const Vector3d dp = shape.radius_m * (-std::sin(angle) * u + std::cos(angle) * w);
      const Vector3d q = across(shape.centre_m + p);
      const Vector3d dq = dp - along * along.dot(dp);
      const Vector3d ddq = -p + along * along.dot(p);
      const double step = q.dot(dq) / (dq.squaredNorm() + q.dot(ddq));
      angle -= step;
      if (std::abs(step) < kConverged) break;
    }
    rim += shape.radius_m * (std::cos(angle) * u + std::sin(angle) * w);
  }
  gap = across(rim);
  if (std::abs(along.dot(rim - middle)) > cable.length_m / 2) return false;
  // The side on which the wheel is: towards the wheel's centre, also when the rim has entered the cable.
  const Vector3d outward = across(shape.centre_m).normalized();
  const double side = gap.dot(outward) >= 0 ? 1 : -1;
  const double length = gap.norm();
  nearest.normal = length > 1e-9 ? Vector3d(side * gap / length) : outward;
  nearest.distance_m = side * length - radius_m;
  nearest.point_m = middle + along * along.dot(rim - middle) + radius_m * nearest.normal;
  return true;
}

}  // namespace umbsim
