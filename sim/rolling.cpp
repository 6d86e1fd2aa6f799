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

#include "sim/dynamics/sticking.h"
#include "sim/world_state.h"

namespace umbsim {
namespace {

using Eigen::Vector3d;

constexpr int kRounds = 6;
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

// How far a support may travel in the step.
double World::State::way_m(double step_s, bool kicked) const {
  const double speed_mps = body.velocity().segment<3>(3).norm();
  return step_s * (speed_mps + step_s * options.gravity_mps2 + (kicked ? kFastestKick_mps : 0));
}

// Those that are contacts whatever the velocity without contacts will be. False where that is not known yet.
bool World::State::find_certain_contacts(double step_s, const std::array<double, 2>& target_radps, bool kicked) {
  find_contacts(step_s, kSpeculative_m, way_m(step_s, kicked), expected_radps(target_radps));
  return !doubtful;
}

// Speed of the contact's point before the step, with held wheels at their set speeds.
void World::State::start_contact(const Contact& c, const Rolling& now, Sticking& sticking) const {
  const Support& s = supports[c.support];
  const DofVector& before = body.velocity();
  sticking.known = before.segment<3>(3) + Vector3d(before.head<3>()).cross(c.lever.arm_m);
  if (s.wheel >= 0) {
    sticking.known += now.wheel_radps[s.wheel] * c.lever.turn_m[0];
    sticking.leg = now.held.wheel_leg[s.wheel];
    return;
  }
  sticking.leg = s.joint >= 2 ? (s.joint - 2) / 2 : -1;
  for (int i = 0; i < c.lever.joints; ++i) sticking.known += before[6 + c.lever.joint[i]] * c.lever.turn_m[i];
}

// One spring carries both: the floor's and a cable's.
bool World::State::shares_spring(const Contact& c) const {
  return supports[c.support].spring.sprung() && std::any_of(contact, contact + contacts, [&](const Contact& other) {
           return other.support == c.support && &other != &c;
         });
}

bool World::State::start_rolling(double step_s, Rolling& now) {
  const std::array<bool, 2> free{wheel_is_free(0, now), wheel_is_free(1, now)};
  for (int i = 0; i < 2; ++i) now.wheel_radps[i] = free[std::size_t(i)] ? body.velocity()[6 + i] : now.shaft[i].radps;
  now.held = body.held(step_s, {now.wheel_radps[0], now.wheel_radps[1]}, free);
  for (int i = 0; i < contacts; ++i) {
    if (sprung && shares_spring(contact[i])) return false;
    start_contact(contact[i], now, now.sticking[i]);
    now.patch[i] = turning_patch(contact[i], step_s);
  }
  int leg = 0;
  for (const Caster& c : robot.casters) {
    if (!c.swivels) continue;
    const double rolling_radps = body.velocity()[6 + body.legs()[std::size_t(leg)].wheel];
    now.swivel[leg].limit = c.swivel_friction_nm * step_s;
    if (c.swivel_friction_nm > 0) now.swivel[leg].compliance = swivel_compliance(c, rolling_radps, step_s);
    ++leg;
  }
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
  for (int i = 0; i < 2; ++i) {
    const int leg = now.held.wheel_leg[i], state = grip.motor[i];
    const Shaft& shaft = now.shaft[i];
    if (leg >= 0 && std::abs(state) == 1) motion.turn_wheel(leg, state * shaft.limit);
    if (leg >= 0 && state == 0) motion.hold_wheel(leg, body.velocity()[6 + i] - shaft.radps, shaft.give);
  }
  for (int leg = 0; leg < int(body.legs().size()); ++leg) {
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
  for (int leg = 0; leg < int(body.legs().size()); ++leg) {
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

bool World::State::none_slides(const Rolling& now) const {
  return std::none_of(now.sticking, now.sticking + contacts, [](const Sticking& s) { return s.slides; });
}

// True if they do with every contact that touches sticking.
bool World::State::hold(double step_s, const Impulse& given, Rolling& now, StickingProblem& motion) {
  let_stick(step_s, now);
  for (int round = 0; round < kRounds; ++round) {
    motion.start(now.held, given, true);
    if (!solve_rolling(now, motion)) return false;
    const Laws laws = check_sticking(now);
    if (laws == Laws::slide) return false;
    const Laws bounded_laws = check_bounded(motion, now);
    if (stops_change(step_s, now))
      let_stick(step_s, now);
    else if (laws == Laws::hold && bounded_laws == Laws::hold)
      return true;
  }
  return false;
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

// The speeds that follow, and what the next step begins with.
void World::State::finish_rolling(const StickingProblem& motion, const Rolling& now, DofVector& u) {
  u = body.velocity();
  u.head<3>() += motion.turning();
  u.segment<3>(3) += motion.moving();
  for (int i = 0; i < 2; ++i) {
    const int leg = now.held.wheel_leg[i];
    u[6 + i] = now.wheel_radps[i] + (leg < 0 ? 0 : motion.wheel_radps(leg));
  }
  for (int leg = 0; leg < int(body.legs().size()); ++leg) {
    u[6 + body.legs()[std::size_t(leg)].fork] += motion.fork_radps(leg);
    u[6 + body.legs()[std::size_t(leg)].wheel] += motion.wheel_radps(leg);
  }
  const bool slides = !none_slides(now);
  for (int i = 0; i < contacts && (slides || grip.slipped); ++i) {
    grip.slip[i] = slides ? now.touch[i].slip : Vector3d(Vector3d::Zero());
  }
  grip.slipped = slides;
  write_impulses(now);
  report = {};
  grip.all_stick = !slides && grip.all_hold();
  if (!grip.all_stick) report.outcome = SolveOutcome::newton;
}

bool World::State::step_rolling(double step_s, const std::array<double, 2>& target_radps, const Impulse& given,
                                DofVector& u) {
  Rolling now;
  StickingProblem motion;
  if (grip.contacts != contacts) grip = {}, grip.contacts = contacts;
  start_shafts(step_s, target_radps, now);
  for (int round = 0; round < kRounds; ++round) {
    const bool free = grip.motor[0] != 0 || grip.motor[1] != 0;
    if ((free && off_centre()) || !start_rolling(step_s, now) || !hold_or_slide(step_s, given, now, motion)) break;
    if (!check_motors(motion, now)) continue;
    finish_rolling(motion, now, u);
    return true;
  }
  grip = {};
  return false;
}

}  // namespace umbsim
