#include "sim/world.h"

#include <cmath>
#include <string>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "core/error.h"
#include "sim/contact_solver.h"
#include "sim/multibody.h"

namespace umbsim {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

// Speed that a newton leaves between two surfaces in "rigid" contact. It makes the problem regular (the lateral
// friction of both wheels lies on one line); at 100 N it is 0.1 um/s.
constexpr double kMobility = 1e-9;  // m/s per N
constexpr double kSpeculative_m = 0.001;  // contacts this far ahead are watched, beyond what the step can travel
constexpr double kSettle_s = 0.2;
constexpr double kNearCable_m = 0.02;

// A wheel, ball or caster wheel that may touch the floor.
struct Support {
  int joint = -1;       // -1: a ball fixed to the base
  Vector3d centre_m;    // base frame, of a fixed ball
  double radius_m = 0;
  bool disc = false;
  double friction_scale = 0;  // times the floor's; balls have a coefficient of their own
  double own_friction = 0;
  std::string name;
  // Normal compliance; stiffness 0 stands for rigid.
  double sink_m = 0;
  double stiffness_npm = 0;
  double damping_nspm = 0;
};

std::vector<Support> supports_of(const RobotModel& robot, const MultiBody& body) {
  std::vector<Support> supports;
  for (int i = 0; i < 2; ++i) {
    const Wheel& w = robot.wheels[i];
    supports.push_back({i, w.centre_m, w.radius_m, true, 1, 0, i == 0 ? "left wheel" : "right wheel"});
  }
  for (std::size_t i = 0; i < robot.casters.size(); ++i) {
    const Caster& c = robot.casters[i];
    if (c.swivels) {
      supports.push_back({body.caster_wheel_joint(int(i)), c.centre_m, c.radius_m, true, 1, 0, "caster " + c.link});
    } else {
      supports.push_back({-1, c.centre_m, c.radius_m, false, 0, c.friction, "caster " + c.link});
    }
  }
  return supports;
}

Quaterniond upright(double heading_rad, double roll_rad, double pitch_rad) {
  return Quaterniond(Eigen::AngleAxisd(heading_rad, Vector3d::UnitZ())) *
         Quaterniond(Eigen::AngleAxisd(pitch_rad, Vector3d::UnitY())) *
         Quaterniond(Eigen::AngleAxisd(roll_rad, Vector3d::UnitX()));
}

}  // namespace

struct World::State {
  RobotModel robot;
  Drivetrain drivetrain;
  Floor floor;
  PhysicsOptions options;
  MultiBody body;
  std::vector<Support> supports;
  SupportLoads loads;
  PhysicsCost cost;
  std::array<double, 2> command_radps{};
  std::array<double, 2> last_command_radps{};
  std::array<double, 2> zero_angle_rad{};
  double heading_rad = 0;
  RowVector impulses;
  // Rows of the current step.
  ContactProblem problem;
  DofVector row[kMaxRows];
  DofVector response[kMaxRows];   // M^-1 times the row
  double compliance[kMaxRows]{};  // velocity per impulse, added to the diagonal
  int rows = 0;
  int contact_support[8]{};

  State(const RobotModel& r, const Drivetrain& d, const Floor& f, const PhysicsOptions& o)
      : robot(r), drivetrain(d), floor(f), options(o), body(r, o.gravity_mps2), supports(supports_of(r, body)) {
    if (supports.size() > 8) throw InputError(robot.urdf + ": more than six casters are not supported");
    soften();
  }

  RollingShape shape(const Support& s) const {
    if (s.joint < 0) return {body.position() + body.rotation() * s.centre_m, Vector3d::Zero(), s.radius_m + s.sink_m};
    const Joint at = body.current(s.joint);
    return {body.position() + body.rotation() * at.pivot_m,
            s.disc ? Vector3d(body.rotation() * at.axis) : Vector3d(Vector3d::Zero()), s.radius_m + s.sink_m};
  }

  void step(double step_s, const std::array<double, 2>& target_radps);
  void add_contacts(double step_s, const DofVector& u);
  void add_contact(int support, const RollingShape& round, const NearestPoint& nearest, double step_s,
                   const DofVector& u);
  void add_motor(int wheel, double target_radps, double step_s, const DofVector& u);
  template <int N>
  void assemble(const DofMatrix& M_inverse, int dofs);
  void solve(double step_s, DofVector& u);
  void place_on_floor(const Pose2& X_WB);
  void soften();
  void check_loads() const;
  void check_finite(const DofVector& u) const;
  bool near_cable() const;
  void track_heading();
  double raw_heading() const { return std::atan2(body.rotation()(1, 0), body.rotation()(0, 0)); }
};

void World::State::step(double step_s, const std::array<double, 2>& target_radps) {
  DofVector u = body.free_velocity(step_s);
  rows = 0;
  problem.contacts = problem.motors = 0;
  add_contacts(step_s, u);
  for (int i = 0; i < 2; ++i) add_motor(i, target_radps[i], step_s, u);
  solve(step_s, u);
  body.set_velocity(u);
  body.integrate(step_s);
  track_heading();
  ++cost.steps;
  cost.simulated_s += step_s;
  check_finite(u);
}

void World::State::add_contacts(double step_s, const DofVector& u) {
  problem.b.resize(kMaxRows);
  const double watch_m = kSpeculative_m + step_s * u.segment<3>(3).norm();
  for (int i = 0; i < int(supports.size()); ++i) {
    const RollingShape round = shape(supports[i]);
    const NearestPoint ground = nearest_on_floor(floor, round);
    if (ground.distance_m < watch_m) add_contact(i, round, ground, step_s, u);
    for (const Cable& cable : floor.cables) {
      NearestPoint nearest;
      const double reach_m = round.radius_m + cable.length_m + cable.height_m;
      if (std::hypot(round.centre_m.x() - cable.x_m, round.centre_m.y() - cable.y_m) > reach_m) continue;
      if (nearest_on_cable(floor, cable, round, nearest) && nearest.distance_m < watch_m && problem.contacts < 8) {
        add_contact(i, round, nearest, step_s, u);
      }
    }
  }
}

// Unilateral row. A gap may close within the step but not become negative. In contact the row is a spring and damper
// taken implicitly: impulse x = h (k (sink - h v) + ... - d v), that is v + x / (h (h k + d)) = sink k / (h k + d).
// Friction rows along the wheel's rolling direction and across it, at the rolling radius.
void World::State::add_contact(int support, const RollingShape& round, const NearestPoint& nearest, double step_s,
                               const DofVector& u) {
  const Support& s = supports[support];
  const Matrix3d R_BW = body.rotation().transpose();
  const Vector3d normal = R_BW * nearest.normal;
  const Vector3d centre = R_BW * (round.centre_m - body.position());
  const Vector3d axis = R_BW * round.axis;
  const Vector3d rim = centre - s.radius_m * (s.disc ? (normal - axis * axis.dot(normal)).normalized() : normal);
  const double friction = s.friction_scale * floor.friction + s.own_friction;
  problem.contact[problem.contacts] = {rows, friction};
  contact_support[problem.contacts++] = support;

  row[rows] = body.jacobian(s.joint, rim, normal);
  const double spring = step_s * s.stiffness_npm + s.damping_nspm;
  const bool soft = s.stiffness_npm > 0;
  const double gap_m = nearest.distance_m;
  compliance[rows] = soft ? 1 / (step_s * spring) : kMobility / step_s;
  problem.b[rows] = row[rows].dot(u) + (soft && gap_m < 0 ? gap_m * s.stiffness_npm / spring : gap_m / step_s);
  ++rows;
  if (friction <= 0) return;
  const Vector3d along = (s.disc ? axis : Vector3d(Vector3d::UnitY())).cross(normal).normalized();
  const Vector3d across = normal.cross(along);
  for (const Vector3d& direction : {along, across}) {
    row[rows] = body.jacobian(s.joint, rim, direction);
    compliance[rows] = kMobility / step_s;
    problem.b[rows] = row[rows].dot(u);
    ++rows;
  }
}

void World::State::add_motor(int wheel, double target_radps, double step_s, const DofVector& u) {
  problem.motor[problem.motors++] = {rows, drivetrain.torque_limit_nm * step_s};
  row[rows] = DofVector::Unit(body.dofs(), 6 + wheel);
  compliance[rows] = 0;
  problem.b[rows] = u[6 + wheel] - target_radps;
  ++rows;
}

// A = J M^-1 J^T + compliance. N: number of degrees of freedom at compile time where it is the usual one.
template <int N>
void World::State::assemble(const DofMatrix& M_inverse, int dofs) {
  using Vector = Eigen::Matrix<double, N, 1, 0, N == Eigen::Dynamic ? kMaxDofs : N, 1>;
  const auto at = [dofs](DofVector& v) { return Eigen::Map<Vector>(v.data(), dofs); };
  const Eigen::Map<const Eigen::Matrix<double, N, N>> M(M_inverse.data(), dofs, dofs);
  problem.A.resize(rows, rows);
  for (int i = 0; i < rows; ++i) {
    response[i].resize(dofs);
    at(response[i]).noalias() = M.lazyProduct(at(row[i]));
    for (int j = 0; j <= i; ++j) problem.A(i, j) = problem.A(j, i) = at(row[j]).dot(at(response[i]));
    problem.A(i, i) += compliance[i];
  }
}

void World::State::solve(double step_s, DofVector& u) {
  constexpr int kUsual = 8;  // base and two wheels
  const DofMatrix& M_inverse = body.inverse_mass();
  if (body.dofs() == kUsual) assemble<kUsual>(M_inverse, kUsual);
  else assemble<Eigen::Dynamic>(M_inverse, body.dofs());
  problem.b.conservativeResize(rows);
  const SolveReport report = solve_contacts(problem, impulses);
  cost.newton_steps += report.outcome != SolveOutcome::stick;
  cost.solver_fallbacks += report.outcome == SolveOutcome::fallback;
  for (int i = 0; i < rows; ++i) u += response[i] * impulses[i];

  loads = {};
  for (int i = 0; i < problem.contacts; ++i) {
    const int support = contact_support[i];
    double& load = support < 2 ? loads.wheel_n[support] : loads.caster_n[support - 2];
    load += impulses[problem.contact[i].normal] / step_s;
  }
}

// Height, roll and pitch at which all supports touch (Gauss-Newton; exact for three supports).
void World::State::place_on_floor(const Pose2& X_WB) {
  const auto gaps = [&](const Vector3d& q) {
    body.set_pose(upright(X_WB.theta_rad, q[1], q[2]), Vector3d(X_WB.x_m, X_WB.y_m, q[0]));
    Eigen::VectorXd gap(supports.size());
    for (std::size_t i = 0; i < supports.size(); ++i) {
      gap[i] = nearest_on_floor(floor, shape(supports[i])).distance_m + supports[i].sink_m;
    }
    return gap;
  };
  Vector3d q(floor_at(floor, X_WB.x_m, X_WB.y_m).height_m + robot.wheels[0].radius_m, 0, 0);
  for (int i = 0; i < 20; ++i) {
    const Eigen::VectorXd gap = gaps(q);
    Eigen::MatrixXd slope(gap.size(), 3);
    for (int k = 0; k < 3; ++k) {
      constexpr double kDelta = 1e-6;
      const Vector3d d = Vector3d::Unit(k) * kDelta;
      slope.col(k) = (gaps(q + d) - gaps(q - d)) / (2 * kDelta);
    }
    const Vector3d change = slope.colPivHouseholderQr().solve(gap);
    q -= change;
    if (change.norm() < 1e-14) break;
  }
  gaps(q);
}

// Gives every support the spring and damper that sinks by the stated amount under its load at rest on a flat floor.
void World::State::soften() {
  const double sink_m = options.softness.static_sink_m;
  if (sink_m <= 0) return;
  Floor flat;
  std::swap(floor, flat);
  place_on_floor({});
  for (int i = 0; i < 3; ++i) step(options.fine_step_s, {0, 0});
  std::swap(floor, flat);
  for (std::size_t i = 0; i < supports.size(); ++i) {
    const double load = std::max(i < 2 ? loads.wheel_n[i] : loads.caster_n[i - 2],
                                 0.05 * robot.total_mass_kg() * options.gravity_mps2);
    supports[i].sink_m = sink_m;
    supports[i].stiffness_npm = load / sink_m;
    // 2 zeta sqrt(k m) with m the load's mass
    supports[i].damping_nspm = 2 * options.softness.damping_ratio * load / std::sqrt(options.gravity_mps2 * sink_m);
  }
}

void World::State::check_loads() const {
  for (std::size_t i = 0; i < supports.size(); ++i) {
    const double load = i < 2 ? loads.wheel_n[i] : loads.caster_n[i - 2];
    const bool must_carry = i < 2 || supports.size() == 3;
    if (load > 0 || !must_carry) continue;
    throw InputError(fmt::format(
        "{}: the robot does not stand: after settling its {} carries no load (left wheel {:.1f} N, right wheel {:.1f} "
        "N). The centre of mass must lie between the drive wheels and the casters.",
        robot.urdf, supports[i].name, loads.wheel_n[0], loads.wheel_n[1]));
  }
}

void World::State::check_finite(const DofVector& u) const {
  if (u.allFinite() && body.position().allFinite()) return;
  std::string which = u.head<6>().allFinite() ? "a wheel or caster" : "the base";
  throw RunError(fmt::format("{}: the state became non-finite after {:.3f} simulated seconds, in {}", robot.urdf,
                             cost.simulated_s, which));
}

bool World::State::near_cable() const {
  for (const Cable& cable : floor.cables) {
    for (const Support& s : supports) {
      const Vector3d centre = shape(s).centre_m;
      const double across_m = std::abs((centre.x() - cable.x_m) * std::sin(cable.direction_rad) -
                                       (centre.y() - cable.y_m) * std::cos(cable.direction_rad));
      const double along_m = std::abs((centre.x() - cable.x_m) * std::cos(cable.direction_rad) +
                                      (centre.y() - cable.y_m) * std::sin(cable.direction_rad));
      const double reach_m = std::sqrt(2 * s.radius_m * cable.height_m) + kNearCable_m;
      if (across_m < reach_m && along_m < cable.length_m / 2 + kNearCable_m) return true;
    }
  }
  return false;
}

void World::State::track_heading() { heading_rad += wrap_angle(raw_heading() - heading_rad); }

World::World(const RobotModel& robot, const Drivetrain& drivetrain, const Floor& floor, const PhysicsOptions& options)
    : state_(std::make_unique<State>(robot, drivetrain, floor, options)) {}
World::~World() = default;
World::World(World&&) noexcept = default;

void World::place(const Pose2& X_WB) {
  State& s = *state_;
  s.body.set_velocity(DofVector::Zero(s.body.dofs()));
  s.place_on_floor(X_WB);
  s.heading_rad = X_WB.theta_rad;
  s.command_radps = s.last_command_radps = {};
  advance(kSettle_s);
  s.check_loads();
  for (int i = 0; i < 2; ++i) s.zero_angle_rad[i] = s.body.joint_angle(i);
  s.cost = {};
}

void World::command(double left_radps, double right_radps) { state_->command_radps = {left_radps, right_radps}; }

void World::advance(double duration_s) {
  State& s = *state_;
  const double longest_s = s.near_cable() ? s.options.fine_step_s : s.options.step_s;
  const int steps = std::max(1, int(std::ceil(duration_s / longest_s - 1e-9)));
  for (int k = 1; k <= steps; ++k) {
    const double part = double(k) / steps;
    std::array<double, 2> target;
    for (int i = 0; i < 2; ++i) target[i] = (1 - part) * s.last_command_radps[i] + part * s.command_radps[i];
    s.step(duration_s / steps, target);
  }
  s.last_command_radps = s.command_radps;
}

void World::lay_cable(const Cable& cable) { state_->floor.cables.push_back(cable); }

Pose2 World::pose() const {
  const Vector3d& p = state_->body.position();
  return {p.x(), p.y(), state_->heading_rad};
}

double World::wheel_angle(int wheel) const {
  return state_->body.joint_angle(wheel) - state_->zero_angle_rad[wheel];
}
double World::wheel_speed(int wheel) const { return state_->body.velocity()[6 + wheel]; }
Vector3d World::wheel_centre(int wheel) const { return state_->shape(state_->supports[wheel]).centre_m; }
Vector3d World::up() const { return state_->body.rotation().col(2); }
const SupportLoads& World::loads() const { return state_->loads; }
const PhysicsCost& World::cost() const { return state_->cost; }
double World::energy() const { return state_->body.energy(); }

}  // namespace umbsim
