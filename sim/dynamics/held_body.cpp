// The equations of motion of a base with wheels and swivelling casters, in closed form: what sim/rolling.cpp needs of
// them. Featherstone's composite bodies, written out for a tree of this shape. Moments are about the base's centre of
// mass, all in the base frame.
#include <cmath>

#include "sim/dynamics/multibody.h"

namespace umbsim {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// r x (r x ..) of a point mass: |r|^2 - r r^T.
Matrix3d spread(const Vector3d& r) { return r.squaredNorm() * Matrix3d::Identity() - r * r.transpose(); }

void add(MassAbout& sum, double mass_kg, const Vector3d& r, const Matrix3d& inertia_kgm2) {
  sum.mass_kg += mass_kg;
  sum.moment_kgm += mass_kg * r;
  sum.inertia_kgm2 += inertia_kgm2 + mass_kg * spread(r);
}

Matrix3d wheel_inertia(const Vector3d& axis, double spin_kgm2, double transverse_kgm2) {
  return transverse_kgm2 * Matrix3d::Identity() + (spin_kgm2 - transverse_kgm2) * axis * axis.transpose();
}

}  // namespace

void MultiBody::add_up_masses() {
  add(locked_, robot_.base.mass_kg, Vector3d::Zero(), robot_.base.inertia_kgm2);
  for (const Wheel& w : robot_.wheels) {
    add(locked_, w.mass_kg, w.centre_m - com_B_, wheel_inertia(w.axis, w.spin_inertia_kgm2, w.transverse_inertia_kgm2));
  }
  for (std::size_t i = 0; i < robot_.casters.size(); ++i) {
    const Caster& c = robot_.casters[i];
    if (!c.swivels) continue;
    SwivelLeg leg;
    leg.wheel = caster_wheel_joint_[i];
    leg.fork = joints_[std::size_t(leg.wheel)].parent;
    leg.pivot_m = c.swivel_point_m - com_B_;
    leg.spin_kgm2 = c.wheel_spin_inertia_kgm2;
    add(leg.drawn, c.fork.mass_kg, c.fork.com_m - c.swivel_point_m, c.fork.inertia_kgm2);
    add(leg.drawn, c.wheel_mass_kg, c.centre_m - c.swivel_point_m,
        wheel_inertia(Vector3d::UnitY(), c.wheel_spin_inertia_kgm2, c.wheel_transverse_inertia_kgm2));
    legs_.push_back(leg);
  }
  swing_legs();
}

void MultiBody::swing_legs() {
  for (SwivelLeg& leg : legs_) {
    const double c = leg.cosine = std::cos(angle_rad_[leg.fork]), s = leg.sine = std::sin(angle_rad_[leg.fork]);
    const Vector3d& m = leg.drawn.moment_kgm;
    const Matrix3d& I = leg.drawn.inertia_kgm2;
    leg.axle = {-s, c, 0};
    leg.now.mass_kg = leg.drawn.mass_kg;
    leg.now.moment_kgm = {c * m.x() - s * m.y(), s * m.x() + c * m.y(), m.z()};
    // R I R^T for a turn about z.
    const double xx = c * c * I(0, 0) - 2 * c * s * I(0, 1) + s * s * I(1, 1);
    const double yy = s * s * I(0, 0) + 2 * c * s * I(0, 1) + c * c * I(1, 1);
    const double xy = c * s * (I(0, 0) - I(1, 1)) + (c * c - s * s) * I(0, 1);
    const double xz = c * I(0, 2) - s * I(1, 2), yz = s * I(0, 2) + c * I(1, 2);
    leg.now.inertia_kgm2 << xx, xy, xz, xy, yy, yz, xz, yz, I(2, 2);
  }
}

// A tree that turns with w, joints locked, has the momenta L = I w + m c x v and P = m v + w x m c; spinning wheels add
// theirs. What changes them in a step is weight and, seen from the turning base, gyroscopic terms, -w x L and -w x P;
// that part of these which only turns v with the base belongs to the coordinates (integrate()).
MultiBody::Momentum MultiBody::held_momentum(double step_s, const std::array<double, 2>& target_radps,
                                             const std::array<bool, 2>& free) const {
  const Vector3d w = u_.head<3>();
  const Vector3d gravity = R_WB_.transpose() * gravity_mps2_;
  const Vector3d along = w.cross(locked_.moment_kgm);
  Vector3d turning = locked_.inertia_kgm2 * w, wheels = Vector3d::Zero();
  for (int i = 0; i < 2; ++i) {
    const Wheel& wheel = robot_.wheels[i];
    turning += (wheel.spin_inertia_kgm2 * u_[6 + i]) * wheel.axis;
    if (!free[i]) wheels += (wheel.spin_inertia_kgm2 * (u_[6 + i] - target_radps[i])) * wheel.axis;
  }
  return {wheels + step_s * (locked_.moment_kgm.cross(gravity) - w.cross(turning)),
          step_s * (locked_.mass_kg * gravity - w.cross(along))};
}

HeldBody MultiBody::held(double step_s, const std::array<double, 2>& target_radps,
                         const std::array<bool, 2>& free) const {
  HeldBody h;
  h.all = locked_;
  const Momentum momentum = held_momentum(step_s, target_radps, free);
  h.turning_kgm2ps = momentum.turning_kgm2ps;
  h.pushing_kgmps = momentum.pushing_kgmps;
  for (const SwivelLeg& leg : legs_) add_leg(leg, step_s, h);
  for (int i = 0; i < 2; ++i) {
    if (!free[i]) continue;
    const Wheel& wheel = robot_.wheels[i];
    h.wheel_leg[i] = h.legs;
    const Vector3d none = Vector3d::Zero();
    h.leg[h.legs++] = {none, none, wheel.spin_inertia_kgm2 * wheel.axis, 1, wheel.spin_inertia_kgm2, 0, 0};
  }
  return h;
}

// Fork and wheel turn with f = w + rate z, the wheel spins about its axle besides. F and N: force, and moment about the
// swivel's pivot, that this motion needs while no rate changes.
void MultiBody::add_leg(const SwivelLeg& leg, double step_s, HeldBody& held) const {
  const Vector3d w = u_.head<3>(), z = Vector3d::UnitZ();
  const Vector3d gravity = R_WB_.transpose() * gravity_mps2_;
  const double rate = u_[6 + leg.fork], spin = leg.spin_kgm2 * u_[6 + leg.wheel];
  const double mass_kg = leg.now.mass_kg;
  const Vector3d &s = leg.pivot_m, &r = leg.now.moment_kgm;
  const Matrix3d& I = leg.now.inertia_kgm2;
  HeldBody::Leg& l = held.leg[held.legs++];

  l.pushing = z.cross(r);
  l.turning = I.col(2) + s.cross(l.pushing);
  l.spinning = leg.spin_kgm2 * leg.axle;
  l.fork_kgm2 = I(2, 2);
  l.wheel_kgm2 = leg.spin_kgm2;

  const Vector3d f = w + rate * z, turns = rate * w.cross(z), pivot_mps2 = w.cross(w.cross(s));
  const Vector3d F = mass_kg * pivot_mps2 + turns.cross(r) + f.cross(f.cross(r));
  const Vector3d N = I * turns + f.cross(I * f) + r.cross(pivot_mps2) + spin * f.cross(leg.axle);
  const Vector3d moment = mass_kg * s + r;

  held.all.mass_kg += mass_kg;
  held.all.moment_kgm += moment;
  held.all.inertia_kgm2 +=
      I + mass_kg * spread(s) + 2 * s.dot(r) * Matrix3d::Identity() - s * r.transpose() - r * s.transpose();
  held.turning_kgm2ps += step_s * (moment.cross(gravity) - N - s.cross(F));
  held.pushing_kgmps += step_s * (mass_kg * gravity - F);
  l.fork_kgm2ps = step_s * (r.cross(gravity) - N).z();
  l.wheel_kgm2ps = -step_s * leg.spin_kgm2 * leg.axle.dot(turns);
}

}  // namespace umbsim
