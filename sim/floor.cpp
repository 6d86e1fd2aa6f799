#include "sim/floor.h"

#include <cmath>

#include <Eigen/Geometry>

#include "core/random.h"

namespace umbsim {
namespace {

using Eigen::Vector3d;

constexpr int kNewtonSteps = 8;
constexpr double kConverged = 1e-13;

// The direction in the disc's plane that points most nearly along `towards`.
Vector3d in_plane(const Vector3d& axis, const Vector3d& towards) {
  return (towards - axis * axis.dot(towards)).normalized();
}

}  // namespace

double friction_at(const Floor& floor, double x_m, double y_m) {
  double friction = floor.friction;
  for (const FrictionPatch& p : floor.patches) {
    if (std::hypot(x_m - p.x_m, y_m - p.y_m) < p.radius_m) friction = p.friction;
  }
  return friction;
}

FloorPoint floor_at(const Floor& floor, double x_m, double y_m) {
  FloorPoint at;
  for (const Ripple& r : floor.ripples) {
    const double phase = r.kx_radpm * x_m + r.ky_radpm * y_m + r.phase_rad;
    const double slope = -r.amplitude_m * std::sin(phase);
    at.height_m += r.amplitude_m * std::cos(phase);
    at.slope_x += slope * r.kx_radpm;
    at.slope_y += slope * r.ky_radpm;
  }
  return at;
}

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

NearestPoint nearest_on_floor(const Floor& floor, const RollingShape& shape) {
  const bool ball = shape.axis.isZero();
  Vector3d normal = Vector3d::UnitZ();
  // The nearest point of disc or ball lies where its own normal opposes the floor's: a fixed-point iteration, which
  // contracts by (floor curvature x radius) each round.
  for (int i = 0;; ++i) {
    const Vector3d towards = ball ? Vector3d(-normal) : in_plane(shape.axis, -normal);
    const Vector3d rim = shape.centre_m + shape.radius_m * towards;
    if (floor.ripples.empty()) return {{rim.x(), rim.y(), 0}, normal, rim.z()};
    const FloorPoint at = floor_at(floor, rim.x(), rim.y());
    const Vector3d next = Vector3d(-at.slope_x, -at.slope_y, 1).normalized();
    const bool converged = (next - normal).squaredNorm() < kConverged * kConverged;
    normal = next;
    if (converged || i == 4 * kNewtonSteps) {
      return {{rim.x(), rim.y(), at.height_m}, normal, (rim.z() - at.height_m) * normal.z()};
    }
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
