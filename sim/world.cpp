#include "sim/world.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "sim/world_state.h"

namespace umbsim {
namespace {

using Eigen::Vector3d;

constexpr double kSettle_s = 0.2;
constexpr double kSettleOnSprings_s = 1;
constexpr double kNearCable_m = 0.02;
constexpr double kFastestCommand_radps = 1e6;

std::vector<Support> supports_of(const RobotModel& robot, const MultiBody& body) {
  std::vector<Support> supports;
  for (int i = 0; i < 2; ++i) {
    const Wheel& w = robot.wheels[i];
    supports.push_back({i, w.centre_m, w.radius_m, true, i, 1, 0, i == 0 ? "left wheel" : "right wheel"});
  }
  for (std::size_t i = 0; i < robot.casters.size(); ++i) {
    const Caster& c = robot.casters[i];
    if (c.swivels) {
      supports.push_back({body.caster_wheel_joint(int(i)), c.centre_m, c.radius_m, true, -1, 1, 0, "caster " + c.link});
    } else {
      supports.push_back({-1, c.centre_m, c.radius_m, false, -1, 0, c.friction, "caster " + c.link});
    }
  }
  for (int i = 0; i < int(supports.size()); ++i) {
    supports[i].spring = i < 2 ? robot.wheels[i].suspension : robot.casters[i - 2].suspension;
  }
  return supports;
}

}  // namespace

World::State::State(const RobotModel& r, const Drivetrain& d, const Floor& f, const PhysicsOptions& o,
                    const std::vector<Push>& p)
    : robot(r), drivetrain(d), floor(f), options(o), pushes(p), body(r), supports(supports_of(r, body)) {
  if (supports.size() > 8) throw InputError(robot.urdf + ": more than six casters are not supported");
  for (const Support& s : supports) {
    sprung = sprung || s.spring.sprung();
    widest_m = std::max(widest_m, s.centre_m.norm() + s.radius_m);
  }
  on_balls = runs_on_balls();
  soften();
}

double World::State::load(const Support& s) const { return s.wheel < 0 ? 0 : loads.wheel_n[s.wheel]; }

double World::State::loaded_radius(const Support& s) const {
  return s.wheel < 0 ? s.radius_m : s.radius_m - robot.wheels[s.wheel].compliance_mpn * load(s);
}

double World::State::rolling_radius(const Support& s) const {
  return s.wheel < 0 ? s.radius_m : radius_factor[s.wheel] * loaded_radius(s);
}

// Base frame, `ahead_rad` of rolling from now. An eccentric wheel carries its rim's centre round its axle.
Vector3d World::State::rim_centre(const Support& s, const Joint& hinge, double ahead_rad) const {
  if (s.wheel < 0 || robot.wheels[s.wheel].eccentricity_m == 0) return hinge.pivot_m;
  const Wheel& w = robot.wheels[s.wheel];
  const Vector3d forward = hinge.axis.cross(Vector3d::UnitZ()).normalized();
  const double angle_rad = body.joint_angle(s.joint) + w.eccentricity_rad + ahead_rad;
  return hinge.pivot_m + w.eccentricity_m * (Eigen::AngleAxisd(angle_rad, hinge.axis) * forward);
}

// The height follows the load at rest only: a feedback would outrun the spring of the contact.
double World::State::outer_radius(const Support& s) const {
  const double squash_m = s.wheel < 0 ? 0 : robot.wheels[s.wheel].compliance_mpn * rest_load_n[s.wheel];
  return s.radius_m - squash_m + s.sink_m;
}

RollingShape World::State::shape(const Support& s) const {
  const double radius_m = outer_radius(s);
  if (s.joint < 0) return {body.position() + body.rotation() * (s.centre_m + shift(s)), Vector3d::Zero(), radius_m};
  const Joint at = body.current(s.joint);
  return {body.position() + body.rotation() * (rim_centre(s, at) + shift(s)),
          s.disc ? Vector3d(body.rotation() * at.axis) : Vector3d(Vector3d::Zero()), radius_m};
}

Vector3d World::State::gravity_mps2() const {
  const double down = options.gravity_mps2 * std::cos(floor.slope_rad),
               along = options.gravity_mps2 * std::sin(floor.slope_rad);
  return {along * std::cos(floor.downhill_rad), along * std::sin(floor.downhill_rad), -down};
}

// Whether a support is on a cable, would be if the gap between them were smaller by `gap_m`, or is up to `margin_m`
// beside.
bool World::State::near_cable(double gap_m, double margin_m) const {
  for (const Cable& cable : floor.cables) {
    const double off_x = body.position().x() - cable.x_m, off_y = body.position().y() - cable.y_m;
    const double farthest_m = 2 * widest_m + cable.length_m + cable.height_m + 2 * gap_m + margin_m;
    if (off_x * off_x + off_y * off_y > farthest_m * farthest_m) continue;
    const double sine = std::sin(cable.direction_rad), cosine = std::cos(cable.direction_rad);
    for (const Support& s : supports) {
      const Vector3d centre = shape(s).centre_m;
      const double across_m = std::abs((centre.x() - cable.x_m) * sine - (centre.y() - cable.y_m) * cosine);
      const double along_m = std::abs((centre.x() - cable.x_m) * cosine + (centre.y() - cable.y_m) * sine);
      const double reach_m = std::sqrt((2 * s.radius_m + gap_m) * (cable.height_m + gap_m)) + margin_m;
      // Where it is not straight across a cable a wheel touches it beside its centre.
      const double beside_m = gap_m > 0 ? reach_m : margin_m;
      if (across_m < reach_m && along_m < cable.length_m / 2 + beside_m) return true;
    }
  }
  return false;
}

World::World(const RobotModel& robot, const Drivetrain& drivetrain, const Floor& floor, const PhysicsOptions& options,
             const std::vector<Push>& pushes)
    : state_(std::make_unique<State>(robot, drivetrain, floor, options, pushes)) {}
World::~World() = default;
World::World(World&&) noexcept = default;

void World::place(const Pose2& X_WB) {
  State& s = *state_;
  s.body.set_velocity(DofVector::Zero(s.body.dofs()));
  for (std::size_t i = 0; i < s.robot.casters.size(); ++i) {
    const Caster& c = s.robot.casters[i];
    if (!c.swivels) continue;
    s.body.set_joint_angle(s.body.joints()[s.body.caster_wheel_joint(int(i))].parent, c.initial_angle_rad);
  }
  s.place_on_floor(X_WB);
  s.set_heading(X_WB.theta_rad);
  s.command_radps = s.last_command_radps = s.set_point_radps = {};
  s.radius_factor = {1, 1};
  s.pull = {};
  const double settle_s = s.sprung ? kSettleOnSprings_s : kSettle_s;
  s.time_s = -settle_s;
  for (int i = 0; i < 2; ++i) s.shaft_rad[i] = s.body.joint_angle(i);
  s.rest_load_n = {};
  advance(settle_s);
  if (s.robot.wheels[0].compliance_mpn > 0 || s.robot.wheels[1].compliance_mpn > 0) {
    s.rest_load_n = s.loads.wheel_n;  // tyres that give: once more, at the height to which they sink
    s.body.set_velocity(DofVector::Zero(s.body.dofs()));
    s.place_on_floor(X_WB);
    advance(settle_s);
  }
  s.check_loads();
  for (int i = 0; i < 2; ++i) s.zero_angle_rad[i] = s.body.joint_angle(i);
  s.time_s = 0;
  s.cost = {};
  for (int i = 0; i < 2; ++i) s.strain[i] = {s.loads.wheel_n[i]};
}

void World::command(double left_radps, double right_radps) {
  for (const double radps : {left_radps, right_radps}) {
    if (!(std::abs(radps) > kFastestCommand_radps)) continue;
    throw InputError(fmt::format(
        "{}: a wheel is commanded to turn at {:g} rad/s (must be >= {:g} and <= {:g}); this comes "
        "from the speeds of the course, from the radii and wheelbase of the odometry, or from a driver that no "
        "longer holds its course",
        state_->robot.urdf, radps, -kFastestCommand_radps, kFastestCommand_radps));
  }
  state_->command_radps = {left_radps, right_radps};
}

void World::advance(double duration_s) {
  State& s = *state_;
  const double longest_s = s.near_cable(0, kNearCable_m) ? s.options.fine_step_s : s.options.step_s;
  const int steps = std::max(1, int(std::ceil(duration_s / longest_s - 1e-9)));
  if (s.by_rolling) s.as_after_one_of(duration_s / steps);
  s.by_rolling = false;
  for (int k = 1; k <= steps; ++k) {
    s.step(duration_s / steps, s.follow_commands(duration_s / steps, double(k) / steps));
  }
  s.last_command_radps = s.command_radps;
}

void World::lay_cable(const Cable& cable) { state_->floor.cables.push_back(cable); }

void World::scale_rolling_radius(int wheel, double factor) { state_->radius_factor[wheel] = factor; }

void World::set_pull(const Pull& pull) { state_->pull = pull; }

void World::set_carpet_drift(double x, double y) {
  state_->floor.drift_x = x;
  state_->floor.drift_y = y;
}

Pose2 World::pose() const {
  const Vector3d& p = state_->body.position();
  return {p.x(), p.y(), state_->heading_rad};
}

double World::wheel_angle(int wheel) const { return state_->body.joint_angle(wheel) - state_->zero_angle_rad[wheel]; }
double World::encoder_angle(int wheel) const {
  if (state_->drivetrain.motor[wheel].backlash_rad == 0) return wheel_angle(wheel);
  return state_->shaft_rad[wheel] - state_->zero_angle_rad[wheel];
}
double World::wheel_speed(int wheel) const { return state_->body.velocity()[6 + wheel]; }
Vector3d World::wheel_centre(int wheel) const { return state_->shape(state_->supports[wheel]).centre_m; }
Vector3d World::up() const { return state_->body.rotation().col(2); }
const SupportLoads& World::loads() const { return state_->loads; }
double World::spring_up_m(int support) const { return state_->supports[support].up_m; }
const PhysicsCost& World::cost() const { return state_->cost; }
double World::energy() const { return state_->body.energy(); }

}  // namespace umbsim
