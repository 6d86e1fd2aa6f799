#include "sim/standing.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/model/inertia.h"
#include "sim/world_state.h"

namespace umbsim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Supports that lie this close to one line, as a share of its length, hold a robot as if it stood on that line.
constexpr double kOneLine = 0.01;

double across(const Vector2d& from, const Vector2d& to, const Vector2d& point) {
  const Vector2d along = (to - from).normalized(), off = point - from;
  return along.x() * off.y() - along.y() * off.x();
}

// Whether the points span an area, so that a body can stand on them.
bool span_area(const std::vector<Vector2d>& points) {
  double length = 0;
  Vector2d a = Vector2d::Zero(), b = Vector2d::Zero();
  for (const Vector2d& p : points) {
    for (const Vector2d& q : points) {
      if ((q - p).norm() <= length) continue;
      length = (q - p).norm();
      a = p, b = q;
    }
  }
  if (length == 0) return false;
  for (const Vector2d& p : points) {
    if (std::abs(across(a, b, p)) > kOneLine * length) return true;
  }
  return false;
}

Inertial wheel_body(const Wheel& w) {
  const double t = w.transverse_inertia_kgm2;
  return {w.mass_kg, w.centre_m, Vector3d(t, w.spin_inertia_kgm2, t).asDiagonal()};
}

Inertial caster_wheel_body(const Caster& c) {
  const double t = c.wheel_transverse_inertia_kgm2;
  return {c.wheel_mass_kg, c.centre_m, Vector3d(t, c.wheel_spin_inertia_kgm2, t).asDiagonal()};
}

// Moment about `about` that the floor must give beside what it gives there, under `motion`; gravity if `weight`.
Vector3d moment_needed(const Standing& s, const Vector3d& about, const FloorMotion& motion, bool weight) {
  const Vector3d &c = s.body.com_m, up = Vector3d::UnitZ();
  const double turning = motion.turning_radps2, speed2 = motion.turning_speed2_radps2;
  Vector3d a(motion.forward_mps2 - turning * c.y() - speed2 * c.x(),
             motion.left_mps2 + turning * c.x() - speed2 * c.y(), 0);
  if (weight) a -= s.gravity_mps2;
  const Vector3d spin = s.body.inertia_kgm2 * up;
  Vector3d change = turning * spin + speed2 * up.cross(spin);  // of the angular momentum
  for (const Wheel& w : s.wheels) {
    const double share = w.spin_inertia_kgm2 / w.radius_m, y_m = w.centre_m.y();
    change.y() += share * (motion.forward_mps2 - turning * y_m);
    change.x() -= share * (motion.left_mps2 - speed2 * y_m);
  }
  return (c - about).cross(s.body.mass_kg * a) + change;
}

std::string way_of(const Vector3d& lean) {
  if (std::abs(lean.x()) >= std::abs(lean.y())) return lean.x() > 0 ? "forwards" : "backwards";
  return lean.y() > 0 ? "to the left" : "to the right";
}

}  // namespace

// About an edge of the polygon only the supports off it can give a moment, and these push upwards alone.
double Standing::largest_share(const FloorMotion& more, const FloorMotion& always) const {
  double share = std::numeric_limits<double>::infinity();
  for (const Vector3d& a : contacts) {
    for (const Vector3d& b : contacts) {
      if ((b - a).head<2>().norm() == 0) continue;
      bool edge = true;
      for (const Vector3d& c : contacts) edge = edge && across(a.head<2>(), b.head<2>(), c.head<2>()) > -1e-9;
      if (!edge) continue;
      const Vector3d along = Vector3d(b.x() - a.x(), b.y() - a.y(), 0).normalized();
      const double held = along.dot(moment_needed(*this, a, always, true));
      const double taken = -along.dot(moment_needed(*this, a, more, false));
      if (held <= 0) return 0;
      if (taken > 0) share = std::min(share, held / taken);
    }
  }
  return share;
}

TippedOver::TippedOver(const std::string& robot, const Fall& how)
    : RunError(fmt::format("{}: the robot tips over {}: {:.2f} s after the start it leans by {:.0f} degrees, {}", robot,
                           how.way, how.noticed_s, how.tilt_rad * 180 / M_PI,
                           how.lifted.empty() ? "with all supports on the floor" : how.lifted + " off the floor")),
      fall(how) {}

Standing World::standing() const {
  const State& s = *state_;
  Standing result;
  result.body = s.robot.base;
  for (const Wheel& w : s.robot.wheels) result.body = lumped(result.body, wheel_body(w));
  for (const Caster& c : s.robot.casters) result.body = lumped(lumped(result.body, c.fork), caster_wheel_body(c));
  Eigen::Isometry3d upright(Eigen::AngleAxisd(-s.heading_rad, Vector3d::UnitZ()) * s.body.orientation());
  result.body = transformed(result.body, upright);
  result.wheels = s.robot.wheels;
  const Eigen::AngleAxisd to_robot(-s.heading_rad, Vector3d::UnitZ());
  for (const Support& support : s.supports) {
    const Vector3d point = nearest_on_floor(s.floor, s.shape(support)).point_m;
    result.contacts.push_back(to_robot * (point - s.body.position()));
  }
  result.gravity_mps2 = to_robot * s.gravity_mps2();
  return result;
}

bool World::State::stands() const {
  const auto carries = [&](std::size_t i) { return (i < 2 ? loads.wheel_n[i] : loads.caster_n[i - 2]) > 0; };
  bool all = true;
  for (std::size_t i = 0; i < supports.size(); ++i) all = all && carries(i);
  if (all) return true;
  std::vector<Vector2d> carrying;
  for (std::size_t i = 0; i < supports.size(); ++i) {
    const Support& s = supports[i];
    const Vector3d at = s.joint < 0 ? s.centre_m : body.current(s.joint).pivot_m;
    if (carries(i)) carrying.push_back(at.head<2>());
  }
  return span_area(carrying);
}

// On supports along one line a robot falls, back or over.
void World::State::watch_standing() {
  if (time_s <= 0 || stands()) {
    stood_s = std::max(0.0, time_s);
    stood_heading_rad = heading_rad;
  }
  const double upright = body.rotation()(2, 2);
  const bool may_come_back = options.may_lean || time_s - stood_s < kMoment_s;
  if (time_s <= 0 || (upright > std::cos(kTippedOver_rad) && may_come_back)) return;
  std::string lifted;
  for (std::size_t i = 0; i < supports.size(); ++i) {
    if ((i < 2 ? loads.wheel_n[i] : loads.caster_n[i - 2]) > 0) continue;
    lifted += (lifted.empty() ? "" : ", ") + supports[i].name;
  }
  const double tilt_rad = std::acos(std::clamp(upright, -1.0, 1.0));
  const Vector3d lean = Eigen::AngleAxisd(-heading_rad, Vector3d::UnitZ()) * Vector3d(body.rotation().col(2));
  throw TippedOver(robot.urdf, {stood_s, time_s, tilt_rad, stood_heading_rad, way_of(lean), lifted});
}

}  // namespace umbsim
