#include "sim/world.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "sim/world_state.h"

namespace umbsim {
namespace {

using Eigen::Vector3d;

constexpr double kSettle_s = 0.2;
constexpr double kNearCable_m = 0.02;

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

}  // namespace

World::State::State(const RobotModel& r, const Drivetrain& d, const Floor& f, const PhysicsOptions& o)
    : robot(r), drivetrain(d), floor(f), options(o), body(r, o.gravity_mps2), supports(supports_of(r, body)) {
  if (supports.size() > 8) throw InputError(robot.urdf + ": more than six casters are not supported");
  soften();
}

RollingShape World::State::shape(const Support& s) const {
  const double radius_m = s.radius_m + s.sink_m;
  if (s.joint < 0) return {body.position() + body.rotation() * s.centre_m, Vector3d::Zero(), radius_m};
  const Joint at = body.current(s.joint);
  return {body.position() + body.rotation() * at.pivot_m,
          s.disc ? Vector3d(body.rotation() * at.axis) : Vector3d(Vector3d::Zero()), radius_m};
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
