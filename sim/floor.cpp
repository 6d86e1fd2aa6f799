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

namespace {

// The floor near one place: its ripples' sines and cosines once, and from there by the theorem of addition, with series
// in the change of phase.
class FloorNear {
 public:
  static constexpr std::size_t kMost = 32;
  static constexpr double kFar = 0.03;  // of a phase; the series' next terms are below 1e-19

  FloorNear(const Floor& floor, double x_m, double y_m) : floor_(floor) { move(x_m, y_m); }

  FloorPoint at(double x_m, double y_m) {
    const std::size_t count = floor_.ripples.size();
    if (count > kMost) return floor_at(floor_, x_m, y_m);
    const double dx = x_m - x_m_, dy = y_m - y_m_;
    FloorPoint at;
    for (std::size_t i = 0; i < count; ++i) {
      const Ripple& r = floor_.ripples[i];
      const double d = r.kx_radpm * dx + r.ky_radpm * dy, d2 = d * d;
      if (d2 > kFar * kFar) {
        move(x_m, y_m);
        return this->at(x_m, y_m);
      }
      const double sine = d * (1 - d2 / 6 * (1 - d2 / 20 * (1 - d2 / 42)));
      const double versine = d2 / 2 * (1 - d2 / 12 * (1 - d2 / 30 * (1 - d2 / 56)));
      const double height = cosine_[i] - versine * cosine_[i] - sine * sine_[i];
      const double slope = -(sine_[i] - versine * sine_[i] + sine * cosine_[i]);
      at.height_m += height;
      at.slope_x += slope * r.kx_radpm;
      at.slope_y += slope * r.ky_radpm;
    }
    return at;
  }

 private:
  void move(double x_m, double y_m) {
    x_m_ = x_m;
    y_m_ = y_m;
    if (floor_.ripples.size() > kMost) return;
    for (std::size_t i = 0; i < floor_.ripples.size(); ++i) {
      const Ripple& r = floor_.ripples[i];
      const double phase = r.kx_radpm * x_m + r.ky_radpm * y_m + r.phase_rad;
      sine_[i] = r.amplitude_m * std::sin(phase);
      cosine_[i] = r.amplitude_m * std::cos(phase);
    }
  }

  const Floor& floor_;
  double x_m_ = 0, y_m_ = 0;
  double sine_[kMost], cosine_[kMost];  // times the amplitude
};

}  // namespace

NearestPoint nearest_on_floor(const Floor& floor, const RollingShape& shape) {
  const bool ball = shape.axis.isZero();
  Vector3d normal = Vector3d::UnitZ();
  const auto rim_at = [&] {
    const Vector3d towards = ball ? Vector3d(-normal) : in_plane(shape.axis, -normal);
    return Vector3d(shape.centre_m + shape.radius_m * towards);
  };
  const Vector3d below = rim_at();
  if (floor.ripples.empty()) return {{below.x(), below.y(), 0}, normal, below.z()};
  FloorNear near(floor, below.x(), below.y());
  // The nearest point of disc or ball lies where its own normal opposes the floor's: a fixed-point iteration, which
  // contracts by (floor curvature x radius) each round.
  for (int i = 0;; ++i) {
    const Vector3d rim = i == 0 ? below : rim_at();
    const FloorPoint at = near.at(rim.x(), rim.y());
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
