// The step of a robot whose wheels and casters hold: nearly every one. Contacts that stick are stiff dampers between
// robot and floor, so that the velocity follows from one small linear problem in the robot's own coordinates,
//
//   (M + J^T C^-1 J) (u - u before) = change of momentum without contacts - J^T C^-1 (J u before + offset),
//
// the same equations as A x + b = 0 of the general step (docs/physics.md), solved for u instead of the impulses
// x = -C^-1 (J u + offset). Each contact enters as a tensor of three by three at its place. Then the laws are checked;
// where one does not hold, the general step is taken.
#include <algorithm>
#include <cmath>

#include "sim/sticking.h"
#include "sim/world_state.h"

namespace umbsim {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int kRounds = 6;
constexpr double kConeSlack = 1e-12;    // as that of the contact solver
constexpr double kFastestKick_mps = 1;  // that a push may give in a step, where it makes contacts doubtful

// A bounded row: side 0 where it holds, else -1 or 1, at its limit. Returns its impulse; true in `changes` where it is
// on another side than was supposed.
double bounded(int& side, double speed, double give, double limit, bool& changes) {
  const int supposed = side;
  const double impulse = supposed == 0 ? -give * speed : supposed * limit;
  if (supposed == 0)
    side = (impulse > limit) - (impulse < -limit);
  else if (speed * supposed > -limit / give)
    side = 0;  // at its limit it still moves against it
  changes = changes || side != supposed;
  return impulse;
}

}  // namespace

// On a spring the contact gives way along z of the base, too: C + z z^T give / h, by the formula of Sherman and
// Morrison.
bool World::State::stick_on_spring(const Contact& c, double step_s, Sticking& sticking) const {
  const Support& s = supports[c.support];
  for (int i = 0; i < contacts; ++i) {
    if (contact[i].support == c.support && &contact[i] != &c) return false;
  }
  sticking.offset.z() += spring_speed(s, 0, step_s);
  if (s.stop != 0) return true;
  const double give = 1 / (step_s * (step_s * s.spring.stiffness_npm + s.spring.damping_nspm));
  const Vector3d upwards = sticking.give.col(2);
  sticking.give -= (give / (1 + give * upwards.z())) * upwards * upwards.transpose();
  return true;
}

bool World::State::stick(const Contact& c, double step_s, const std::array<double, 2>& target_radps,
                         Sticking& sticking) const {
  const Support& s = supports[c.support];
  sticking.give = (1 / c.compliance[0] * c.direction[0]) * c.direction[0].transpose();
  sticking.offset = c.offset[0] * c.direction[0];
  for (int i = 1; i < 3 && c.friction > 0; ++i) {
    sticking.give += (1 / c.compliance[i] * c.direction[i]) * c.direction[i].transpose();
    sticking.offset += c.offset[i] * c.direction[i];
  }
  const DofVector& before = body.velocity();
  sticking.known = before.segment<3>(3) + Vector3d(before.head<3>()).cross(c.lever.arm_m);
  if (s.wheel >= 0) sticking.known += target_radps[s.wheel] * c.lever.turn_m[0];
  sticking.leg = s.joint >= 2 ? (s.joint - 2) / 2 : -1;
  for (int i = 0; i < c.lever.joints && s.wheel < 0; ++i) {
    sticking.known += before[6 + c.lever.joint[i]] * c.lever.turn_m[i];
  }
  return !s.spring.sprung() || stick_on_spring(c, step_s, sticking);
}

// Rows that the forces of the contacts are written into, in the order of the general step.
void World::State::write_impulses(const Vector3d (&force)[8], const double* bounded, int bounded_rows) {
  rows = 0;
  problem.contacts = problem.motors = 0;
  impulses.resize(kMaxRows);
  for (int i = 0; i < contacts; ++i) {
    const Contact& c = contact[i];
    problem.contact[problem.contacts] = {rows, c.friction};
    contact_support[problem.contacts++] = c.support;
    for (int k = 0; k < (c.friction > 0 ? 3 : 1); ++k) impulses[rows++] = c.direction[k].dot(force[i]);
  }
  for (int i = 0; i < bounded_rows; ++i) impulses[rows++] = bounded[i];
  impulses.conservativeResize(rows);
}

// Whether both motors can give what holds the wheels at their speeds.
bool World::State::motors_hold(double step_s, const std::array<double, 2>& target_radps, const Vector3d (&force)[8],
                               const Vector3d& turning) const {
  std::array<double, 2> impulse;
  for (int i = 0; i < 2; ++i) {
    const Wheel& w = robot.wheels[i];
    impulse[i] = w.spin_inertia_kgm2 * (w.axis.dot(turning) + target_radps[i] - body.velocity()[6 + i]);
  }
  for (int i = 0; i < contacts; ++i) {
    const int wheel = supports[contact[i].support].wheel;
    if (wheel >= 0) impulse[wheel] -= contact[i].lever.turn_m[0].dot(force[i]);
  }
  const auto& motor = drivetrain.motor;
  return std::abs(impulse[0]) <= motor[0].torque_limit_nm * step_s &&
         std::abs(impulse[1]) <= motor[1].torque_limit_nm * step_s;
}

bool World::State::may_roll() const {
  if (options.general_steps) return false;
  return std::none_of(drivetrain.motor.begin(), drivetrain.motor.end(),
                      [](const Motor& m) { return m.backlash_rad > 0 || m.torque_limit_nm <= 0; });
}

// Those that are contacts whatever the velocity without contacts will be. False where that is not known yet.
bool World::State::find_certain_contacts(double step_s, const std::array<double, 2>& target_radps, bool kicked) {
  const double speed_mps = body.velocity().segment<3>(3).norm();
  const double change_mps = step_s * options.gravity_mps2 + (kicked ? kFastestKick_mps : 0);
  find_contacts(step_s, kSpeculative_m, step_s * (speed_mps + change_mps), target_radps);
  return !doubtful;
}

bool World::State::start_rolling(double step_s, const std::array<double, 2>& target_radps, Rolling& now) {
  now.held = body.held(step_s, target_radps);
  for (int i = 0; i < contacts; ++i) {
    if (!stick(contact[i], step_s, target_radps, now.sticking[i])) return false;
    now.patch[i] = turning_patch(contact[i], step_s);
  }
  int leg = 0;
  for (const Caster& c : robot.casters) {
    if (!c.swivels) continue;
    const double rolling_radps = body.velocity()[6 + body.legs()[std::size_t(leg)].wheel];
    now.swivel[leg].limit = c.swivel_friction_nm * step_s;
    if (c.swivel_friction_nm > 0)
      now.swivel[leg].compliance = swivel_compliance(c.swivel_friction_nm, rolling_radps, step_s);
    ++leg;
  }
  if (grip.contacts != contacts) grip = {contacts};
  return true;
}

// The linear problem on the branches of the laws that `grip` says.
bool World::State::solve_rolling(const Rolling& now, StickingProblem& motion) const {
  for (int i = 0; i < contacts; ++i) {
    if (!grip.open[i]) motion.add(contact[i].lever, now.sticking[i]);
    if (!now.patch[i].turns) continue;
    const Vector3d& axis = contact[i].direction[0];
    if (grip.patch[i] == 0)
      motion.hold_turning(axis, axis.dot(body.velocity().head<3>()), 1 / now.patch[i].compliance);
    else
      motion.turn(axis, grip.patch[i] * now.patch[i].limit);
  }
  for (int leg = 0; leg < now.held.legs; ++leg) {
    if (now.swivel[leg].limit == 0) continue;
    const double rate = body.velocity()[6 + body.legs()[std::size_t(leg)].fork];
    if (grip.swivel[leg] == 0)
      motion.hold_fork(leg, rate, 1 / now.swivel[leg].compliance);
    else
      motion.turn_fork(leg, grip.swivel[leg] * now.swivel[leg].limit);
  }
  return motion.solve();
}

// What the contacts do at this velocity, and whether the laws are on other branches than supposed.
Laws World::State::check_contacts(const StickingProblem& motion, double step_s, Rolling& now) {
  Laws laws = Laws::hold;
  double force_n[8]{};
  for (int i = 0; i < contacts; ++i) {
    const Contact& c = contact[i];
    const Vector3d speed = motion.speed(c.lever, now.sticking[i]) + now.sticking[i].offset;
    now.force[i].setZero();
    if (grip.open[i]) {
      grip.open[i] = c.direction[0].dot(speed) >= 0;
      if (!grip.open[i]) laws = Laws::change;
      continue;
    }
    now.force[i] = -(now.sticking[i].give * speed);
    const double normal = c.direction[0].dot(now.force[i]);
    grip.open[i] = normal < 0;
    if (grip.open[i]) laws = Laws::change;
    const double cone = c.friction * normal * (1 + kConeSlack);
    if (c.friction > 0 && now.force[i].squaredNorm() - normal * normal > cone * cone) return Laws::broken;
    force_n[c.support] += now.force[i].z() / step_s;
  }
  if (sprung && change_stops(step_s, force_n)) return Laws::broken;
  return laws;
}

Laws World::State::check_bounded(const StickingProblem& motion, Rolling& now) {
  bool changes = false;
  now.bounded_rows = 0;
  const auto check = [&](int& side, double speed, const TurningPatch& p) {
    now.bounded[now.bounded_rows++] = bounded(side, speed, 1 / p.compliance, p.limit, changes);
  };
  const Vector3d turning = body.velocity().head<3>() + motion.turning();
  for (int i = 0; i < contacts; ++i) {
    if (now.patch[i].turns) check(grip.patch[i], contact[i].direction[0].dot(turning), now.patch[i]);
  }
  for (int leg = 0; leg < now.held.legs; ++leg) {
    const double rate = body.velocity()[6 + body.legs()[std::size_t(leg)].fork] + motion.fork_radps(leg);
    if (now.swivel[leg].limit > 0) check(grip.swivel[leg], rate, now.swivel[leg]);
  }
  return changes ? Laws::change : Laws::hold;
}

bool World::State::step_rolling(double step_s, const std::array<double, 2>& target_radps, const Impulse& given,
                                DofVector& u) {
  Rolling now;
  if (!start_rolling(step_s, target_radps, now)) return false;
  for (int round = 0; round < kRounds; ++round) {
    StickingProblem motion(now.held, given);
    if (!solve_rolling(now, motion)) return false;
    const Laws contacts_now = check_contacts(motion, step_s, now);
    if (contacts_now == Laws::broken) return false;
    if (check_bounded(motion, now) == Laws::change || contacts_now == Laws::change) continue;
    if (!motors_hold(step_s, target_radps, now.force, motion.turning())) return false;
    u = body.velocity();
    u.head<3>() += motion.turning();
    u.segment<3>(3) += motion.moving();
    u[6] = target_radps[0];
    u[7] = target_radps[1];
    for (int leg = 0; leg < now.held.legs; ++leg) {
      u[6 + body.legs()[std::size_t(leg)].fork] += motion.fork_radps(leg);
      u[6 + body.legs()[std::size_t(leg)].wheel] += motion.wheel_radps(leg);
    }
    write_impulses(now.force, now.bounded, now.bounded_rows);
    report = {};
    if (!grip.all_hold()) report.outcome = SolveOutcome::newton;
    return true;
  }
  return false;
}

}  // namespace umbsim
