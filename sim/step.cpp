#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "sim/world_state.h"

namespace umbsim {
namespace {

// Degrees of freedom at compile time where they are the usual ones.
constexpr int kBase = 6;
constexpr int kBaseAndWheels = 8;
constexpr double kSmallTurn = 0.03;  // in a step; the series' next term is below 1e-19

}  // namespace

void World::State::step(double step_s, const std::array<double, 2>& target_radps) {
  find_speeds(step_s, target_radps);
  move_on(step_s, target_radps);
}

void World::State::find_speeds(double step_s, const std::array<double, 2>& target_radps) {
  const Impulse given = given_impulse(step_s);
  const bool kicked = !given.isZero(0);
  if (kicked || !is_on_plane(step_s) || !step_on_plane(step_s, target_radps))
    step_anywhere(step_s, target_radps, given);
}

void World::State::move_on(double step_s, const std::array<double, 2>& target_radps) {
  count(report);
  note_loads(step_s);
  note_strain(step_s);
  body.integrate(step_s);
  if (sprung) move_springs(step_s);
  move_shafts(step_s, target_radps);
  time_s += step_s;
  track_heading();
  ++cost.steps;
  cost.simulated_s += step_s;
  last_step_s = step_s;
  check_finite();
  watch_standing();
}

void World::State::step_anywhere(double step_s, const std::array<double, 2>& target_radps, const Impulse& given) {
  const bool kicked = !given.isZero(0);
  const bool found = !options.general_steps && find_certain_contacts(step_s, target_radps, kicked);
  DofVector u;
  if (!found || !step_rolling(step_s, target_radps, given, u)) {
    ++cost.general_steps;
    u = body.free_velocity(step_s);
    if (kicked) u += body.inverse_mass().leftCols<6>().lazyProduct(given);
    if (!step_with_holding_motors(step_s, target_radps, found && !kicked, u))
      step_with_motor_rows(step_s, target_radps, u);
  }
  body.set_velocity(u);
}

// Nearly always both motors can hold their set-points: the wheel speeds are then known, and the contacts act on a
// robot whose wheels cannot give. Exact if the motor impulses that follow are within their limits; otherwise u is as it
// was.
bool World::State::step_with_holding_motors(double step_s, const std::array<double, 2>& target_radps, bool found,
                                            DofVector& u) {
  const HeldMotors* held = body.held_motors();
  const auto& motor = drivetrain.motor;
  if (!held || motor[0].backlash_rad > 0 || motor[1].backlash_rad > 0) return false;
  if (motor_compliance(0, step_s) > 0 || motor_compliance(1, step_s) > 0) return false;
  const Eigen::Vector2d change(target_radps[0] - u[6], target_radps[1] - u[7]);
  DofVector v(kBaseAndWheels);
  v.head<kBaseAndWheels>() = u.head<kBaseAndWheels>() + held->gain.lazyProduct(change);
  add_contacts(step_s, v, target_radps, found);
  assemble<kBase>(held->inverse_mass.data(), kBase, kBaseAndWheels);
  solve(step_s);

  Eigen::Matrix<double, kBaseAndWheels, 1> push = Eigen::Matrix<double, kBaseAndWheels, 1>::Zero();  // J^T x
  for (int i = 0; i < rows; ++i) push += row[i].head<kBaseAndWheels>() * impulses[i];
  const Eigen::Vector2d impulse = held->inertia * change - held->gain.transpose().lazyProduct(push);
  for (int i = 0; i < 2; ++i) {
    if (std::abs(impulse[i]) > motor[i].torque_limit_nm * step_s) return false;
  }
  u = v;
  u.head<kBase>() += held->inverse_mass.topLeftCorner<kBase, kBase>().lazyProduct(push.head<kBase>());
  return true;
}

void World::State::step_with_motor_rows(double step_s, const std::array<double, 2>& target_radps, DofVector& u) {
  add_contacts(step_s, u, target_radps);
  for (int i = 0; i < 2; ++i) {
    if (drivetrain.motor[i].backlash_rad > 0)
      add_backlash(i, target_radps[i], step_s, u);
    else if (drivetrain.motor[i].torque_limit_nm > 0)
      add_motor(i, target_radps[i], step_s, u);
  }
  add_swivel_friction(step_s, u);
  const DofMatrix& M_inverse = body.inverse_mass();
  const int dofs = body.dofs();
  if (dofs == kBaseAndWheels)
    assemble<kBaseAndWheels>(M_inverse.data(), dofs, dofs);
  else
    assemble<Eigen::Dynamic>(M_inverse.data(), dofs, dofs);
  solve(step_s);
  for (int i = 0; i < rows; ++i) u += response[i] * impulses[i];
}

// Dry friction, at most M; swivelling at less than a share of the rolling rate it is in proportion to the rate, hence a
// compliance share * rate / M of the row.
void World::State::add_swivel_friction(double step_s, const DofVector& u) {
  for (std::size_t i = 0; i < robot.casters.size(); ++i) {
    const Caster& c = robot.casters[i];
    if (!c.swivels || c.swivel_friction_nm == 0 || problem.motors == 8) continue;
    const int wheel = body.caster_wheel_joint(int(i)), fork = body.joints()[wheel].parent;
    problem.motor[problem.motors++] = {rows, c.swivel_friction_nm * step_s};
    row[rows] = DofVector::Unit(body.dofs(), 6 + fork);
    compliance[rows] = swivel_compliance(c, body.velocity()[6 + wheel], step_s);
    problem.b[rows] = u[6 + fork];
    ++rows;
  }
}

Impulse World::State::given_impulse(double step_s) const {
  Impulse given = Impulse::Zero();
  if (!pushes.empty()) add_pushes(step_s, given);
  if (pull.force_x_n != 0 || pull.force_y_n != 0 || pull.yaw_nm != 0) add_pull(step_s, given);
  return given;
}

void World::State::add_pushes(double step_s, Impulse& given) const {
  for (const Push& p : pushes) {
    const double overlap_s = std::min(time_s + step_s, p.time_s + p.duration_s) - std::max(time_s, p.time_s);
    if (overlap_s <= 0) continue;
    const Eigen::Vector3d arm = Eigen::Vector3d(p.ahead_m, 0, p.height_m) - body.centre_of_mass();
    const Eigen::Vector3d impulse = p.impulse_ns * overlap_s / p.duration_s *
                                    Eigen::Vector3d(std::cos(p.direction_rad), std::sin(p.direction_rad), 0);
    given.head<3>() += arm.cross(impulse);
    given.tail<3>() += impulse;
  }
}

void World::State::add_pull(double step_s, Impulse& given) const {
  const Eigen::Matrix3d R_BW = body.rotation().transpose();
  const Eigen::Vector3d arm = Eigen::Vector3d(pull.ahead_m, pull.left_m, pull.height_m) - body.centre_of_mass();
  const Eigen::Vector3d impulse = step_s * (R_BW * Eigen::Vector3d(pull.force_x_n, pull.force_y_n, 0));
  given.head<3>() += arm.cross(impulse) + step_s * pull.yaw_nm * R_BW.col(2);
  given.tail<3>() += impulse;
}

// A = J M^-1 J^T + compliance, over the first N degrees of freedom. M_inverse is symmetric: its layout does not matter.
template <int N>
void World::State::assemble(const double* M_inverse, int dofs, int stride) {
  using Vector = Eigen::Matrix<double, N, 1, 0, N == Eigen::Dynamic ? kMaxDofs : N, 1>;
  using Matrix = Eigen::Matrix<double, N, N>;
  const auto at = [dofs](DofVector& v) { return Eigen::Map<Vector>(v.data(), dofs); };
  const Eigen::Map<const Matrix, 0, Eigen::OuterStride<>> M(M_inverse, dofs, dofs, Eigen::OuterStride<>(stride));
  problem.A.resize(rows, rows);
  double* A = problem.A.data();
  for (int i = 0; i < rows; ++i) {
    response[i].resize(body.dofs());
    const Vector answer = M.lazyProduct(at(row[i]));
    at(response[i]) = answer;
    for (int j = 0; j <= i; ++j) A[i * rows + j] = A[j * rows + i] = at(row[j]).dot(answer);
    A[i * rows + i] += compliance[i];
  }
}

void World::State::solve(double step_s) {
  problem.b.conservativeResize(rows);
  if (sprung)
    solve_on_springs(step_s);
  else
    report = solve_contacts(problem, impulses);
}

void World::State::count(const SolveReport& done) {
  cost.newton_steps += done.outcome != SolveOutcome::stick;
  cost.solver_fallbacks += done.outcome == SolveOutcome::fallback;
}

void World::State::note_loads(double step_s) {
  loads = {};
  for (int i = 0; i < problem.contacts; ++i) {
    const int support = contact_support[i];
    double& load = support < 2 ? loads.wheel_n[support] : loads.caster_n[support - 2];
    load += impulses[problem.contact[i].normal] / step_s;
    if (support < 2 && problem.contact[i].friction > 0)
      loads.wheel_along_n[support] += impulses[problem.contact[i].normal + 1] / step_s;
  }
}

void World::State::set_heading(double heading) {
  heading_rad = heading;
  ahead_x = body.rotation()(0, 0);
  ahead_y = body.rotation()(1, 0);
}

// By the turn since the step before: the series of its arc tangent where that is small.
void World::State::track_heading() {
  const double x = body.rotation()(0, 0), y = body.rotation()(1, 0);
  const double across = ahead_x * y - ahead_y * x, along = ahead_x * x + ahead_y * y;
  if (std::abs(across) < kSmallTurn * along) {
    const double t = across / along, t2 = t * t;
    heading_rad += t * (1 - t2 * (1.0 / 3 - t2 * (1.0 / 5 - t2 * (1.0 / 7 - t2 * (1.0 / 9 - t2 / 11)))));
  } else {
    heading_rad += std::atan2(across, along);
  }
  ahead_x = x;
  ahead_y = y;
}

void World::State::check_finite() const {
  const DofVector& u = body.velocity();
  double sum = body.position().sum() + u.head<kBaseAndWheels>().sum();
  for (int i = kBaseAndWheels; i < body.dofs(); ++i) sum += u[i];
  if (std::isfinite(sum)) return;
  std::string which = u.head<6>().allFinite() ? "a wheel or caster" : "the base";
  throw RunError(fmt::format("{}: the state became non-finite after {:.3f} simulated seconds, in {}", robot.urdf,
                             cost.simulated_s, which));
}

}  // namespace umbsim
