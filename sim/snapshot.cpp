#include "sim/snapshot.h"

#include <algorithm>
#include <cmath>

#include "sim/world_state.h"

namespace umbsim {
namespace {

static_assert(std::tuple_size<decltype(Snapshot::velocity)>::value == kMaxDofs);

constexpr double kAlike = 1e-8;
constexpr double kAlike_n = 1e-4;

template <class Values>
bool alike(const Values& a, const Values& b, double within) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!(std::abs(a[i] - b[i]) < within)) return false;
  }
  return true;
}

}  // namespace

bool goes_on_alike(const Snapshot& a, const Snapshot& b) {
  const Eigen::Vector3d up_a = a.q_WB.conjugate() * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d up_b = b.q_WB.conjugate() * Eigen::Vector3d::UnitZ();
  return alike(a.velocity, b.velocity, kAlike) && alike(a.joint_rad, b.joint_rad, kAlike) &&
         alike(a.set_point_radps, b.set_point_radps, kAlike) && alike(a.shaft_rad, b.shaft_rad, kAlike) &&
         alike(a.radius_factor, b.radius_factor, kAlike) && alike(a.spring_up_m, b.spring_up_m, kAlike) &&
         std::abs(a.p_WB_m.z() - b.p_WB_m.z()) < kAlike && (up_a - up_b).norm() < kAlike &&
         alike(a.loads.wheel_n, b.loads.wheel_n, kAlike_n) && alike(a.loads.caster_n, b.loads.caster_n, kAlike_n);
}

ContactsBefore World::State::contacts_before() const {
  ContactsBefore now{grip, impulses, {}, problem.contacts};
  std::copy_n(problem.contact, problem.contacts, now.rows.begin());
  return now;
}

void World::State::begin_from(const ContactsBefore& before) {
  grip = before.grip;
  impulses = before.impulses;
  problem.contacts = before.contacts;
  std::copy_n(before.rows.begin(), before.contacts, problem.contact);
}

Snapshot World::snapshot() const {
  const State& s = *state_;
  Snapshot now;
  now.q_WB = s.body.orientation();
  now.p_WB_m = s.body.position();
  const DofVector& u = s.body.velocity();
  for (int i = 0; i < s.body.dofs(); ++i) now.velocity[std::size_t(i)] = u[i];
  for (std::size_t i = 0; i < s.body.joints().size(); ++i) now.joint_rad[i] = s.body.joint_angle(int(i));
  now.command_radps = s.last_command_radps;
  now.set_point_radps = s.set_point_radps;
  now.shaft_rad = s.shaft_rad;
  now.zero_angle_rad = s.zero_angle_rad;
  now.radius_factor = s.radius_factor;
  now.rest_load_n = s.rest_load_n;
  for (std::size_t i = 0; i < s.supports.size(); ++i) now.spring_up_m[i] = s.supports[i].up_m;
  now.loads = s.loads;
  now.time_s = s.time_s;
  now.last_step_s = s.last_step_s;
  now.heading_rad = s.heading_rad;
  now.contacts = s.contacts_before();
  return now;
}

void World::resume(const Snapshot& then, const Pose2& X_moved) {
  State& s = *state_;
  const Eigen::Quaterniond turned(Eigen::AngleAxisd(X_moved.theta_rad, Eigen::Vector3d::UnitZ()));
  const Eigen::Vector3d shift(X_moved.x_m, X_moved.y_m, 0);
  s.body.set_pose(turned * then.q_WB, shift + turned * then.p_WB_m);
  DofVector u(s.body.dofs());
  for (int i = 0; i < s.body.dofs(); ++i) u[i] = then.velocity[std::size_t(i)];
  s.body.set_velocity(u);
  for (std::size_t i = 0; i < s.body.joints().size(); ++i) s.body.set_joint_angle(int(i), then.joint_rad[i]);
  s.command_radps = s.last_command_radps = then.command_radps;
  s.set_point_radps = then.set_point_radps;
  s.shaft_rad = then.shaft_rad;
  s.zero_angle_rad = then.zero_angle_rad;
  s.radius_factor = then.radius_factor;
  s.rest_load_n = then.rest_load_n;
  for (std::size_t i = 0; i < s.supports.size(); ++i) {
    s.supports[i].up_m = then.spring_up_m[i];
    s.supports[i].up_mps = 0;
    s.supports[i].stop = 0;
  }
  s.loads = then.loads;
  s.time_s = then.time_s;
  s.last_step_s = then.last_step_s;
  s.by_rolling = false;
  s.set_heading(then.heading_rad + X_moved.theta_rad);
  s.stood_s = then.time_s;
  s.begin_from(then.contacts);
}

}  // namespace umbsim
