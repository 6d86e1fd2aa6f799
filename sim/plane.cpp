// The rolling step on a plane, for a robot on two drive wheels and balls: nearly every step of a square. All contacts
// have the plane's normal n, and what holds a wheel along the floor is the same in every direction. With the velocity v
// of the point midway between where both wheels touch, e from there to the left one and P what is left of a vector
// without its part along n, the equations of sim/rolling.cpp are
//
//   (I + 2 g t t^T + sum of g_i b_i b_i^T) dw + c x dv + sum of g_i b_i (n . dv) = torques,   t = e x along, e x across
//   (m + 2 g) P dv - P (c x dw) = P forces                                                    b_i = r_i x n
//   (m + sum of g_i) (n . dv) + (c x n + sum of g_i b_i) . dw = n . forces
//
// with g and g_i the impulse per speed of a wheel along the floor and of support i along n, and m, c and I the mass,
// its moment and its inertia about that point. Moving with it, the stiff g are felt by one turn only, and three
// equations for dw are left.
#include <cmath>

#include "sim/world_state.h"

namespace umbsim {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

void add_product(Matrix3d& sum, const Vector3d& a, const Vector3d& b) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j <= i; ++j) sum(i, j) += a[i] * b[j];
  }
}

void add_square(Matrix3d& sum, double factor, const Vector3d& v) { add_product(sum, factor * v, v); }

// factor |P (w x r)|^2 as a form in w; `across` is r x n.
void add_level_square(Matrix3d& sum, double factor, const Vector3d& r, const Vector3d& across) {
  for (int i = 0; i < 3; ++i) sum(i, i) += factor * r.squaredNorm();
  add_square(sum, -factor, r);
  add_square(sum, -factor, across);
}

// Inertia and moment about another point: the lower half of the matrix.
MassAbout moved(const MassAbout& from, const Vector3d& to) {
  MassAbout m = from;
  m.moment_kgm -= from.mass_kg * to;
  const double round = from.mass_kg * to.squaredNorm() - 2 * from.moment_kgm.dot(to);
  for (int i = 0; i < 3; ++i) {
    m.inertia_kgm2(i, i) += round;
    for (int j = 0; j <= i; ++j) {
      m.inertia_kgm2(i, j) += from.moment_kgm[i] * to[j] + to[i] * m.moment_kgm[j];
    }
  }
  return m;
}

// K x = right by the lower half of K. False if K is not positive definite.
bool solve_three(const Matrix3d& K, Vector3d& x) {
  const double a = K(0, 0);
  if (!(a > 0)) return false;
  const double l10 = K(1, 0) / a, l20 = K(2, 0) / a;
  const double b = K(1, 1) - l10 * K(1, 0);
  if (!(b > 0)) return false;
  const double k21 = K(2, 1) - l20 * K(1, 0), l21 = k21 / b;
  const double c = K(2, 2) - l20 * K(2, 0) - l21 * k21;
  if (!(c > 0)) return false;
  x[1] -= l10 * x[0];
  x[2] = (x[2] - l20 * x[0] - l21 * x[1]) / c;
  x[1] = x[1] / b - l21 * x[2];
  x[0] = x[0] / a - l10 * x[1] - l20 * x[2];
  return true;
}

}  // namespace

// Of the robot alone. A wheel's rim and creep, and a caster's bearing, need the steps of sim/rolling.cpp.
bool World::State::runs_on_balls() const {
  if (options.general_steps || sprung || !body.legs().empty()) return false;
  for (const Wheel& w : robot.wheels) {
    if (w.eccentricity_m != 0 || w.gives_way() || w.patch_width_m != 0) return false;
  }
  for (const Motor& m : drivetrain.motor) {
    if (m.backlash_rad > 0 || m.droop_radps_per_nm > 0 || m.torque_limit_nm <= 0) return false;
  }
  for (const Caster& c : robot.casters) {
    if (c.friction > 0) return false;
  }
  return true;
}

bool World::State::is_on_plane(double step_s) const {
  if (!on_balls || grip.slipped || !floor.ripples.empty() || !floor.patches.empty()) return false;
  if (floor.friction <= 0 || floor.drift_x != 0 || floor.drift_y != 0) return false;
  return floor.cables.empty() || !near_cable(kSpeculative_m + way_m(step_s, false), 0);
}

// False if a support is not near enough to the floor.
bool World::State::touch_plane(double step_s, OnPlane& now) const {
  now.normal = body.rotation().row(2);
  const Vector3d& n = now.normal;
  const double height_m = body.position().z();
  for (int i = 0; i < int(supports.size()); ++i) {
    const Support& s = supports[std::size_t(i)];
    double depth_m = outer_radius(s);
    now.arm_m[i] = s.centre_m - body.centre_of_mass();
    if (i < 2) {
      const Vector3d& axis = robot.wheels[std::size_t(i)].axis;
      const double leaning = axis.dot(n), upright = std::sqrt(1 - leaning * leaning), share = 1 / upright;
      depth_m *= upright;
      now.rolling_m[i] = rolling_radius(s);
      now.along[i] = share * axis.cross(n);
      now.across[i] = n.cross(now.along[i]);
      now.arm_m[i] += (now.rolling_m[i] * share) * (leaning * axis - n);
    } else {
      now.arm_m[i] -= s.radius_m * n;
    }
    const double gap_m = height_m + n.dot(s.centre_m) - depth_m;
    if (!(gap_m < kSpeculative_m)) return false;
    const double spring = step_s * s.stiffness_npm + s.damping_nspm;
    const bool soft = s.stiffness_npm > 0;
    now.give[i] = soft ? step_s * spring : step_s / kMobility;
    now.speed_mps[i] = soft && gap_m < 0 ? gap_m * s.stiffness_npm / spring : gap_m / step_s;
  }
  now.middle_m = 0.5 * (now.arm_m[0] + now.arm_m[1]);
  now.half_m = now.arm_m[0] - now.middle_m;
  return true;
}

// Balance of momentum about the middle between both wheels' contacts: changes of w, and of the velocity there.
bool World::State::solve_on_plane(double step_s, const std::array<double, 2>& target_radps, OnPlane& now) const {
  const DofVector& u = body.velocity();
  const Vector3d &n = now.normal, w = u.head<3>(), &e = now.half_m;
  const double hold = step_s / kMobility;
  const Vector3d v = u.segment<3>(3) + w.cross(now.middle_m), turned = w.cross(e);
  now.slip_mps[0] = v + turned - (now.rolling_m[0] * target_radps[0]) * now.along[0];
  now.slip_mps[1] = v - turned - (now.rolling_m[1] * target_radps[1]) * now.along[1];

  const MassAbout mass = moved(body.locked(), now.middle_m);
  const MultiBody::Momentum free = body.held_momentum(step_s, target_radps);
  const auto level = [&n](const Vector3d& x) { return Vector3d(x - n.dot(x) * n); };
  const double level_kg = mass.mass_kg + 2 * hold;
  const Vector3d force = level(free.pushing_kgmps - hold * (now.slip_mps[0] + now.slip_mps[1])) / level_kg;
  now.turning = free.turning_kgm2ps - now.middle_m.cross(free.pushing_kgmps) - mass.moment_kgm.cross(force) -
                e.cross(hold * level(now.slip_mps[0] - now.slip_mps[1]));
  double upwards = n.dot(free.pushing_kgmps), upright_kg = mass.mass_kg;
  Vector3d coupled = mass.moment_kgm.cross(n);
  Matrix3d K = mass.inertia_kgm2;
  add_level_square(K, -1 / level_kg, mass.moment_kgm, coupled);
  add_square(K, 2 * hold, e.cross(now.along[0]));
  add_square(K, 2 * hold, e.cross(now.across[0]));
  const double rising_mps = n.dot(v);
  for (int i = 0; i < int(supports.size()); ++i) {
    const Vector3d b = now.turn_m[i] = (now.arm_m[i] - now.middle_m).cross(n);
    now.speed_mps[i] += rising_mps + b.dot(w);
    const Vector3d given = now.give[i] * b;
    coupled += given;
    now.turning -= now.speed_mps[i] * given;
    upwards -= now.speed_mps[i] * now.give[i];
    upright_kg += now.give[i];
    add_product(K, given, b);
  }
  add_square(K, -1 / upright_kg, coupled);
  now.turning -= (upwards / upright_kg) * coupled;
  if (!solve_three(K, now.turning)) return false;
  now.rising = (upwards - coupled.dot(now.turning)) / upright_kg;
  now.moving = force + level(mass.moment_kgm.cross(now.turning)) / level_kg + now.rising * n;
  return true;
}

// False where a contact opens or slides, or a motor cannot hold its wheel.
bool World::State::holds_on_plane(double step_s, const std::array<double, 2>& target_radps, OnPlane& now) const {
  for (int i = 0; i < int(supports.size()); ++i) {
    now.push_ns[i] = -now.give[i] * (now.speed_mps[i] + now.rising + now.turn_m[i].dot(now.turning));
    if (!(now.push_ns[i] >= 0)) return false;
  }
  const double hold = step_s / kMobility;
  const Vector3d turned = now.turning.cross(now.half_m);
  for (int i = 0; i < 2; ++i) {
    const Wheel& wheel = robot.wheels[std::size_t(i)];
    const Vector3d slip_mps = now.slip_mps[i] + now.moving + (i == 0 ? turned : Vector3d(-turned));
    const double along = now.along_ns[i] = -hold * now.along[i].dot(slip_mps);
    const double across = now.across_ns[i] = -hold * now.across[i].dot(slip_mps);
    const double cone = floor.friction * now.push_ns[i] * (1 + kConeSlack);
    if (!(along * along + across * across <= cone * cone)) return false;
    const double spun_radps = wheel.axis.dot(now.turning) + target_radps[std::size_t(i)] - body.velocity()[6 + i];
    const double motor = wheel.spin_inertia_kgm2 * spun_radps + now.rolling_m[i] * along;
    if (!(std::abs(motor) <= drivetrain.motor[std::size_t(i)].torque_limit_nm * step_s)) return false;
  }
  return true;
}

// Into the rows that a general step would have, in its order.
void World::State::write_on_plane(const OnPlane& now) {
  contacts = problem.contacts = int(supports.size());
  problem.motors = 0;
  rows = contacts + 4;
  impulses.resize(rows);
  for (int i = 0, at = 0; i < contacts; ++i) {
    contact_support[i] = i;
    problem.contact[i] = {at, i < 2 ? floor.friction : 0};
    impulses[at++] = now.push_ns[i];
    if (i >= 2) continue;
    impulses[at++] = now.along_ns[i];
    impulses[at++] = now.across_ns[i];
  }
  report = {};
  if (grip.all_stick) return;
  grip = {};
  grip.contacts = contacts;
  grip.all_stick = true;
}

bool World::State::step_on_plane(double step_s, const std::array<double, 2>& target_radps) {
  OnPlane now;
  if (!touch_plane(step_s, now) || !solve_on_plane(step_s, target_radps, now)) return false;
  if (!holds_on_plane(step_s, target_radps, now)) return false;
  write_on_plane(now);
  body.change_velocity(now.turning, now.moving - now.turning.cross(now.middle_m), target_radps);
  return true;
}

}  // namespace umbsim
