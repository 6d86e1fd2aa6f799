// Motors and what they drive: set-points, rows of the general step, and the same for the rolling step.
#include <algorithm>
#include <cmath>

#include "sim/dynamics/sticking.h"
#include "sim/world_state.h"

namespace umbsim {

// Set-points of the step that ends at `part` of the control period: the ramp to the new command, behind gain, deadband
// and lag. A lag's exact answer to what is wanted, in the mean over the step: a lag shorter than the step is one, too.
std::array<double, 2> World::State::follow_commands(double step_s, double part) {
  std::array<double, 2> mean_radps;
  for (int i = 0; i < 2; ++i) {
    const Motor& m = drivetrain.motor[i];
    double wanted = m.gain * ((1 - part) * last_command_radps[i] + part * command_radps[i]);
    if (std::abs(wanted) < m.deadband_radps) wanted = 0;
    const double follow = m.lag_s > 0 ? 1 - std::exp(-step_s / m.lag_s) : 1;
    mean_radps[i] = wanted + (set_point_radps[i] - wanted) * follow * m.lag_s / step_s;
    set_point_radps[i] += follow * (wanted - set_point_radps[i]);
  }
  return mean_radps;
}

// Wheel speeds in a step, as far as they are known before it: those of motors that hold are their set speeds, others
// the speeds before.
std::array<double, 2> World::State::expected_radps(const std::array<double, 2>& target_radps) const {
  std::array<double, 2> radps = target_radps;
  for (int i = 0; i < 2; ++i) {
    const Motor& m = drivetrain.motor[i];
    const bool holds = m.backlash_rad == 0 && m.droop_radps_per_nm == 0 && m.torque_limit_nm > 0;
    if (!holds) radps[std::size_t(i)] = body.velocity()[6 + i];
  }
  return radps;
}

// Speed control in proportion, torque = (set speed - speed) / droop: a compliance of the motor's row. While the robot
// is set down its motors hold.
double World::State::motor_compliance(int wheel, double step_s) const {
  return time_s < 0 ? 0 : drivetrain.motor[wheel].droop_radps_per_nm / step_s;
}

void World::State::add_motor(int wheel, double target_radps, double step_s, const DofVector& u) {
  problem.motor[problem.motors++] = {rows, drivetrain.motor[wheel].torque_limit_nm * step_s};
  row[rows] = DofVector::Unit(body.dofs(), 6 + wheel);
  compliance[rows] = motor_compliance(wheel, step_s);
  problem.b[rows] = u[6 + wheel] - target_radps;
  ++rows;
}

// A one-sided row at the end of the play that would be reached first: there the motor's shaft can push the wheel, but
// not pull it.
void World::State::add_backlash(int wheel, double target_radps, double step_s, const DofVector& u) {
  const Motor& m = drivetrain.motor[wheel];
  const double play_rad = shaft_rad[wheel] - body.joint_angle(wheel);
  const double lag_radps = u[6 + wheel] - target_radps;
  const double forward = lag_radps + (m.backlash_rad / 2 - play_rad) / step_s;
  const double backward = -lag_radps + (m.backlash_rad / 2 + play_rad) / step_s;
  const double side = forward <= backward ? 1 : -1;
  problem.motor[problem.motors++] = {rows, m.torque_limit_nm * step_s, 0};
  row[rows] = DofVector::Unit(body.dofs(), 6 + wheel) * side;
  compliance[rows] = motor_compliance(wheel, step_s);
  problem.b[rows] = std::min(forward, backward);
  ++rows;
}

// As add_backlash() of the general step; the wheel's speed without contacts is the one before.
void World::State::start_shafts(double step_s, const std::array<double, 2>& target_radps, Rolling& now) const {
  for (int i = 0; i < 2; ++i) {
    const Motor& m = drivetrain.motor[i];
    Shaft& shaft = now.shaft[i] = {0, target_radps[i], m.torque_limit_nm * step_s};
    const double gives = motor_compliance(i, step_s);
    if (gives > 0 && m.torque_limit_nm > 0) shaft.give = 1 / gives;
    if (m.backlash_rad <= 0) continue;
    const double play_rad = shaft_rad[i] - body.joint_angle(i), lag_radps = body.velocity()[6 + i] - target_radps[i];
    const double forward = (m.backlash_rad / 2 - play_rad) / step_s,
                 backward = (m.backlash_rad / 2 + play_rad) / step_s;
    shaft.side = lag_radps + forward <= -lag_radps + backward ? 1 : -1;
    shaft.radps = shaft.side > 0 ? target_radps[i] - forward : target_radps[i] + backward;
  }
}

// What a motor does that was supposed to be in the state of `grip`: it holds its wheel within its limit, is at its
// limit and still behind its set speed, or has play that does not close.
int World::State::motor_state(int wheel, double impulse, double radps, const Rolling& now) const {
  const Shaft& shaft = now.shaft[wheel];
  const int state = grip.motor[wheel];
  if (shaft.limit <= 0) return 0;
  if (state == 0) {
    if (shaft.side * impulse < 0) return 2;
    return (impulse > shaft.limit) - (impulse < -shaft.limit);
  }
  const int way = state == 2 ? shaft.side : state;
  const double gives_way_radps = state != 2 && shaft.give > 0 ? shaft.limit / shaft.give : 0;
  const bool behind = way * (radps - shaft.radps) < -gives_way_radps;
  return behind == (state != 2) ? state : 0;
}

bool World::State::check_motors(const StickingProblem& motion, const Rolling& now) {
  double impulse[2], radps[2];
  for (int i = 0; i < 2; ++i) {
    const Wheel& w = robot.wheels[i];
    const double before_radps = body.velocity()[6 + i];
    impulse[i] = w.spin_inertia_kgm2 * (w.axis.dot(motion.turning()) + now.wheel_radps[i] - before_radps);
    radps[i] =
        now.held.wheel_leg[i] < 0 ? now.wheel_radps[i] : before_radps + motion.wheel_radps(now.held.wheel_leg[i]);
  }
  for (int i = 0; i < contacts; ++i) {
    const int wheel = supports[contact[i].support].wheel;
    if (wheel >= 0) impulse[wheel] -= contact[i].lever.turn_m[0].dot(now.force[i]);
  }
  bool same = true;
  for (int i = 0; i < 2; ++i) {
    if (now.shaft[i].give > 0) impulse[i] = now.shaft[i].give * (now.shaft[i].radps - radps[i]);
    const int state = motor_state(i, impulse[i], radps[i], now);
    same = same && state == grip.motor[i];
    grip.motor[i] = state;
  }
  return same;
}

// The shaft turns at its set-point; where the wheel cannot follow, the end of the play stops it.
void World::State::move_shafts(double step_s, const std::array<double, 2>& target_radps) {
  for (int i = 0; i < 2; ++i) {
    const double half = drivetrain.motor[i].backlash_rad / 2;
    const double angle_rad = body.joint_angle(i);
    shaft_rad[i] = std::clamp(shaft_rad[i] + target_radps[i] * step_s, angle_rad - half, angle_rad + half);
  }
}

}  // namespace umbsim
