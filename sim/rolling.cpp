// The step of a robot whose motors hold their set-points: nearly every one. Contacts that stick are stiff dampers
// between robot and floor, so that the velocity follows from one small linear problem in the robot's own coordinates,
//
//   (M + J^T C^-1 J) (u - u before) = change of momentum without contacts - J^T C^-1 (J u before + offset),
//
// the same equations as A x + b = 0 of the general step (docs/physics.md), solved for u instead of the impulses
// x = -C^-1 (J u + offset). Each contact enters as a tensor of three by three at its place. Where one slides, opens or
// closes, its impulse is another function of the velocity, and Newton's method finds where all of them balance.
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "sim/sticking.h"
#include "sim/world_state.h"

namespace umbsim {
namespace {

using Eigen::Vector3d;

constexpr int kRounds = 6;
constexpr int kNewtonSteps = 15;
constexpr double kBalanced = 1e-11;     // of the largest impulse
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

// Speed of the contact's point before the step, with the wheels at their set speeds.
void World::State::start_contact(const Contact& c, const std::array<double, 2>& target_radps, Sticking& now) const {
  const Support& s = supports[c.support];
  const DofVector& before = body.velocity();
  now.known = before.segment<3>(3) + Vector3d(before.head<3>()).cross(c.lever.arm_m);
  now.leg = s.joint >= 2 ? (s.joint - 2) / 2 : -1;
  if (s.wheel >= 0) {
    now.known += target_radps[s.wheel] * c.lever.turn_m[0];
    return;
  }
  for (int i = 0; i < c.lever.joints; ++i) now.known += before[6 + c.lever.joint[i]] * c.lever.turn_m[i];
}

// One spring carries both: the floor's and a cable's.
bool World::State::shares_spring(const Contact& c) const {
  return supports[c.support].spring.sprung() && std::any_of(contact, contact + contacts, [&](const Contact& other) {
           return other.support == c.support && &other != &c;
         });
}

bool World::State::start_rolling(double step_s, const std::array<double, 2>& target_radps, Rolling& now) {
  now.held = body.held(step_s, target_radps);
  for (int i = 0; i < contacts; ++i) {
    if (sprung && shares_spring(contact[i])) return false;
    start_contact(contact[i], target_radps, now.sticking[i]);
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
  if (grip.contacts != contacts) grip = {}, grip.contacts = contacts;
  return true;
}

void World::State::set_springs(double step_s) {
  for (int i = 0; i < contacts && sprung; ++i) {
    const Support& s = supports[contact[i].support];
    contact[i].spring_mps = spring_speed(s, 0, step_s);
    contact[i].spring_give =
        s.spring.sprung() && s.stop == 0 ? 1 / (step_s * (step_s * s.spring.stiffness_npm + s.spring.damping_nspm)) : 0;
  }
}

// All contacts stick, but for those that were open in the step before.
void World::State::let_stick(double step_s, Rolling& now) {
  set_springs(step_s);
  for (int i = 0; i < contacts; ++i) {
    const Tangent t = sticking_tangent(contact[i]);
    Sticking& s = now.sticking[i];
    s.slides = false;
    s.give = t.give;
    s.push = t.push - t.give * s.known;
  }
}

// With bounded rows on the side that `grip` says, and contacts as `now` has them.
bool World::State::solve_rolling(Rolling& now, StickingProblem& motion) const {
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
  if (!motion.solve()) return false;
  for (int i = 0; i < contacts; ++i) now.change[i] = motion.change(contact[i].lever, now.sticking[i]);
  return true;
}

// Whether contacts that were supposed to stick, or to be open, do.
Laws World::State::check_sticking(Rolling& now) {
  Laws laws = Laws::hold;
  for (int i = 0; i < contacts; ++i) {
    const Contact& c = contact[i];
    now.force[i].setZero();
    if (grip.open[i]) {
      const Vector3d speed = now.sticking[i].known + now.change[i] + c.spring_mps * Vector3d::UnitZ();
      grip.open[i] = c.direction[0].dot(speed) + c.offset[0] >= 0;
      if (!grip.open[i]) laws = Laws::change;
      continue;
    }
    now.force[i] = now.sticking[i].push - now.sticking[i].give * now.change[i];
    const double normal = c.direction[0].dot(now.force[i]);
    grip.open[i] = normal < 0;
    if (grip.open[i]) laws = Laws::change;
    const double cone = c.friction * normal * (1 + kConeSlack);
    if (c.friction > 0 && now.force[i].squaredNorm() - normal * normal > cone * cone) return Laws::slide;
  }
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

bool World::State::stops_change(double step_s, const Rolling& now) {
  if (!sprung) return false;
  double force_n[8]{};
  for (int i = 0; i < contacts; ++i) force_n[contact[i].support] += now.force[i].z() / step_s;
  return change_stops(step_s, force_n);
}

// Impulse per speed of a locked body, at each contact.
void World::State::set_likeness(Rolling& now) const {
  const MassAbout& all = now.held.all;
  const Vector3d centre = all.moment_kgm / all.mass_kg;
  const Eigen::Matrix3d own = centre.squaredNorm() * Eigen::Matrix3d::Identity() - centre * centre.transpose();
  const Eigen::Matrix3d turns = (all.inertia_kgm2 - all.mass_kg * own).inverse();
  for (int i = 0; i < contacts; ++i) {
    double speed[3];
    for (int k = 0; k < 3; ++k) {
      const Vector3d turn = (contact[i].lever.arm_m - centre).cross(contact[i].direction[k]);
      speed[k] =
          1 / all.mass_kg + turn.dot(turns * turn) + (k == 0 || contact[i].friction > 0 ? contact[i].compliance[k] : 0);
    }
    now.like[i] = {1 / speed[0], 2 / (speed[1] + speed[2])};
  }
}

void World::State::take_tangents(Rolling& now) {
  for (int i = 0; i < contacts; ++i) {
    const Tangent t = now.tangent[i] = tangent(contact[i], now.touch[i], now.like[i]);
    Sticking& s = now.sticking[i];
    s.give = t.give;
    s.push = t.push - t.give * s.known;
    s.slides = t.slides;
    grip.open[i] = t.open;
  }
}

// What the tangents say of the contacts. Returns how far this is from the laws, of the largest impulse.
double World::State::touch_all(Rolling& now) {
  double off = 0, largest = 1e-9;
  for (int i = 0; i < contacts; ++i) {
    const Contact& c = contact[i];
    const Touch& t = now.touch[i] = touch(c, now.tangent[i], now.sticking[i].known + now.change[i]);
    now.force[i] = t.impulse[0] * c.direction[0];
    if (c.friction > 0) now.force[i] += t.impulse[1] * c.direction[1] + t.impulse[2] * c.direction[2];
    largest = std::max(largest, t.impulse.cwiseAbs().maxCoeff());
    off = std::max(off, unbalance(c, t, now.like[i]));
  }
  return off / largest;
}

// Newton's method, from what `now.touch` says.
bool World::State::slide(double step_s, const Impulse& given, Rolling& now, StickingProblem& motion) {
  for (int i = 0; i < kNewtonSteps; ++i) {
    set_springs(step_s);
    take_tangents(now);
    motion.start(now.held, given, none_slides(now));
    if (!solve_rolling(now, motion)) return false;
    const bool balanced = touch_all(now) < kBalanced;
    const bool stops = stops_change(step_s, now);
    if (check_bounded(motion, now) == Laws::hold && balanced && !stops) return true;
  }
  return false;
}

// What the contacts did in the step before.
void World::State::take_touch_before(Rolling& now) const {
  for (int i = 0; i < contacts; ++i) {
    Touch& t = now.touch[i];
    t.slip = grip.slip[i];
    t.impulse.setZero();
    if (problem.contacts != contacts) continue;
    const ContactRows& before = problem.contact[i];
    for (int k = 0; k < (before.friction > 0 ? 3 : 1); ++k) t.impulse[k] = impulses[before.normal + k];
  }
}

bool World::State::none_slides(const Rolling& now) const {
  return std::none_of(now.sticking, now.sticking + contacts, [](const Sticking& s) { return s.slides; });
}

bool World::State::hold_or_slide(double step_s, const Impulse& given, Rolling& now, StickingProblem& motion) {
  let_stick(step_s, now);
  for (int round = 0; round < kRounds; ++round) {
    motion.start(now.held, given, true);
    if (!solve_rolling(now, motion)) return false;
    const Laws laws = check_sticking(now);
    if (laws == Laws::slide) break;
    const Laws bounded_laws = check_bounded(motion, now);
    if (stops_change(step_s, now))
      let_stick(step_s, now);
    else if (laws == Laws::hold && bounded_laws == Laws::hold)
      return true;
  }
  // From where the contacts were in the step before, and from where they would be if all stuck.
  set_likeness(now);
  Touch stuck[8];
  for (int i = 0; i < contacts; ++i) now.tangent[i] = sticking_tangent(contact[i]);
  touch_all(now);
  std::copy(now.touch, now.touch + contacts, stuck);
  take_touch_before(now);
  if (slide(step_s, given, now, motion)) return true;
  std::copy(stuck, stuck + contacts, now.touch);
  return slide(step_s, given, now, motion);
}

// Whether both motors can give what holds the wheels at their speeds.
bool World::State::motors_hold(double step_s, const std::array<double, 2>& target_radps, const Rolling& now,
                               const Vector3d& turning) const {
  std::array<double, 2> impulse;
  for (int i = 0; i < 2; ++i) {
    const Wheel& w = robot.wheels[i];
    impulse[i] = w.spin_inertia_kgm2 * (w.axis.dot(turning) + target_radps[i] - body.velocity()[6 + i]);
  }
  for (int i = 0; i < contacts; ++i) {
    const int wheel = supports[contact[i].support].wheel;
    if (wheel >= 0) impulse[wheel] -= contact[i].lever.turn_m[0].dot(now.force[i]);
  }
  const auto& motor = drivetrain.motor;
  return std::abs(impulse[0]) <= motor[0].torque_limit_nm * step_s &&
         std::abs(impulse[1]) <= motor[1].torque_limit_nm * step_s;
}

// Rows that the forces of the contacts are written into, in the order of the general step.
void World::State::write_impulses(const Rolling& now) {
  rows = 0;
  problem.contacts = problem.motors = 0;
  impulses.resize(kMaxRows);
  for (int i = 0; i < contacts; ++i) {
    const Contact& c = contact[i];
    problem.contact[problem.contacts] = {rows, c.friction};
    contact_support[problem.contacts++] = c.support;
    for (int k = 0; k < (c.friction > 0 ? 3 : 1); ++k) impulses[rows++] = c.direction[k].dot(now.force[i]);
  }
  for (int i = 0; i < now.bounded_rows; ++i) impulses[rows++] = now.bounded[i];
  impulses.conservativeResize(rows);
}

bool World::State::step_rolling(double step_s, const std::array<double, 2>& target_radps, const Impulse& given,
                                DofVector& u) {
  Rolling now;
  if (!start_rolling(step_s, target_radps, now)) return false;
  StickingProblem motion;
  if (!hold_or_slide(step_s, given, now, motion) || !motors_hold(step_s, target_radps, now, motion.turning())) {
    grip = {};
    return false;
  }
  u = body.velocity();
  u.head<3>() += motion.turning();
  u.segment<3>(3) += motion.moving();
  u[6] = target_radps[0];
  u[7] = target_radps[1];
  bool slides = false;
  for (int leg = 0; leg < now.held.legs; ++leg) {
    u[6 + body.legs()[std::size_t(leg)].fork] += motion.fork_radps(leg);
    u[6 + body.legs()[std::size_t(leg)].wheel] += motion.wheel_radps(leg);
  }
  for (int i = 0; i < contacts; ++i) {
    slides = slides || now.sticking[i].slides;
  }
  if (slides || grip.slipped) {
    for (int i = 0; i < contacts; ++i) grip.slip[i] = slides ? now.touch[i].slip : Vector3d(Vector3d::Zero());
  }
  grip.slipped = slides;
  write_impulses(now);
  report = {};
  if (slides || !grip.all_hold()) report.outcome = SolveOutcome::newton;
  return true;
}

}  // namespace umbsim
