// The rolling step where contacts slide, open or close: Newton's method on the projections of the laws (Alart and
// Curnier 1991), each contact's impulses eliminated by its own tangent.
#include <Eigen/LU>
#include <algorithm>

#include "sim/dynamics/sticking.h"
#include "sim/world_state.h"

namespace umbsim {
namespace {

using Eigen::Vector3d;

constexpr int kNewtonSteps = 15;
constexpr double kBalanced = 1e-11;  // of the largest impulse

}  // namespace

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

// What slid is supposed to go on sliding. Else Newton's method starts from where the contacts were in the step before,
// then from where they would be if all stuck.
bool World::State::hold_or_slide(double step_s, const Impulse& given, Rolling& now, StickingProblem& motion) {
  const bool slid = grip.slipped;
  const auto slide_on = [&] {
    set_likeness(now);
    take_touch_before(now);
    return slide(step_s, given, now, motion);
  };
  if (slid && slide_on()) return true;
  if (hold(step_s, given, now, motion)) return true;
  Touch stuck[8];
  for (int i = 0; i < contacts; ++i) now.tangent[i] = sticking_tangent(contact[i]);
  set_likeness(now);
  touch_all(now);
  std::copy(now.touch, now.touch + contacts, stuck);
  if (!slid && slide_on()) return true;
  std::copy(stuck, stuck + contacts, now.touch);
  return slide(step_s, given, now, motion);
}

}  // namespace umbsim
