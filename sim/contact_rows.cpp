#include <algorithm>
#include <cmath>

#include "sim/world_state.h"

namespace umbsim {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Share of the robot's weight below which a wheel's creep no longer grows.
constexpr double kLeastLoad = 0.02;
// Turning speed that a newton metre leaves in a sticking patch: both wheels' rows are nearly the same.
constexpr double kSpinMobility = 1e-6;  // rad/s per N m
constexpr double kSpeculative_m = 0.001;  // contacts this far ahead are watched, beyond what the step can travel

// row . u, with the size known when compiling where it is the usual one.
double speed_along(const DofVector& row, const DofVector& u) {
  return row.size() == 8 ? row.head<8>().dot(u.head<8>()) : row.dot(u);
}

}  // namespace

void World::State::add_contacts(double step_s, const DofVector& u) {
  rows = 0;
  problem.contacts = problem.motors = 0;
  problem.b.resize(kMaxRows);
  const double watch_m = kSpeculative_m + step_s * u.segment<3>(3).norm();
  for (int i = 0; i < int(supports.size()); ++i) {
    const RollingShape round = shape(supports[i]);
    const NearestPoint ground = nearest_on_floor(floor, round);
    // A wheel that hangs comes down.
    const double hanging_m = sprung ? step_s * std::abs(spring_speed(supports[i], 0, step_s)) : 0;
    if (ground.distance_m < watch_m + hanging_m) add_contact(i, ground, step_s, u);
    for (const Cable& cable : floor.cables) {
      NearestPoint nearest;
      const double reach_m = round.radius_m + cable.length_m + cable.height_m;
      if (std::hypot(round.centre_m.x() - cable.x_m, round.centre_m.y() - cable.y_m) > reach_m) continue;
      if (nearest_on_cable(floor, cable, round, nearest) && nearest.distance_m < watch_m && problem.contacts < 8) {
        add_contact(i, nearest, step_s, u);
      }
    }
  }
  add_spin_friction(u, step_s);
}

// Unilateral row. A gap may close within the step but not become negative. In contact the row is a spring and damper
// taken implicitly: impulse x = h (k (sink - h v) - d v), that is v + x / (h (h k + d)) = sink k / (h k + d).
// Friction rows along the wheel's rolling direction and across it, at the rolling radius. An eccentric rim is taken
// where it is in the middle of the step: its way round the axle is then exact to second order.
void World::State::add_contact(int support, const NearestPoint& nearest, double step_s, const DofVector& u) {
  const Support& s = supports[support];
  const Matrix3d R_BW = body.rotation().transpose();
  const Vector3d normal = R_BW * nearest.normal;
  const Joint hinge = s.joint >= 0 ? body.current(s.joint) : Joint{-1, s.centre_m, Vector3d::UnitY()};
  const Vector3d& axis = hinge.axis;
  const Vector3d towards = s.disc ? Vector3d((axis * axis.dot(normal) - normal).normalized()) : Vector3d(-normal);
  const double half_step_rad = s.wheel >= 0 ? 0.5 * step_s * u[6 + s.wheel] : 0;
  const Vector3d rim = rim_centre(s, hinge, half_step_rad) + rolling_radius(s) * towards + shift(s);
  const double friction =
      s.friction_scale * friction_at(floor, nearest.point_m.x(), nearest.point_m.y()) + s.own_friction;
  problem.contact[problem.contacts] = {rows, friction};
  contact_support[problem.contacts++] = support;

  const double spring = step_s * s.stiffness_npm + s.damping_nspm;
  const bool soft = s.stiffness_npm > 0;
  const double gap_m = nearest.distance_m;
  const MultiBody::Lever lever = body.lever(s.joint, rim, shift(s));
  body.jacobian(lever, normal, row[rows]);
  compliance[rows] = soft ? 1 / (step_s * spring) : kMobility / step_s;
  problem.b[rows] = speed_along(row[rows], u) + (soft && gap_m < 0 ? gap_m * s.stiffness_npm / spring : gap_m / step_s);
  ++rows;
  if (friction <= 0) return;
  const Vector3d along = axis.cross(normal).normalized();
  const Vector3d across = normal.cross(along);
  const TyreSlip slip = tyre_slip(s);
  const double creep[2] = {std::max(slip.along, slip_of_turning_patch(s, friction, normal)), slip.across};
  const Vector3d surface = R_BW * slip.surface_mps;
  for (int i = 0; i < 2; ++i) {
    const Vector3d& direction = i == 0 ? along : across;
    body.jacobian(lever, direction, row[rows]);
    compliance[rows] = (kMobility + creep[i]) / step_s;
    problem.b[rows] = speed_along(row[rows], u) - surface.dot(direction);
    ++rows;
  }
}

// Creep before sliding is a speed proportional to rolling speed and traction ratio: slip = C v F / N (linear theory,
// e.g. Johnson, Contact Mechanics, 8.3), hence a compliance C v / N of the friction rows. Carpet carries the robot in
// proportion to the distance that it rolls.
TyreSlip World::State::tyre_slip(const Support& s) const {
  if (s.wheel < 0) return {};
  const Wheel& w = robot.wheels[s.wheel];
  if (w.creep_along == 0 && w.creep_across == 0 && floor.drift_x == 0 && floor.drift_y == 0) return {};
  const double speed = std::abs(body.velocity()[6 + s.wheel]) * w.radius_m;
  const double rolled = (std::abs(body.velocity()[6]) + std::abs(body.velocity()[7])) / 2 * w.radius_m;  // by the robot
  const double load_n = creeping_load(s);
  return {w.creep_along * speed / load_n, w.creep_across * speed / load_n,
          {rolled * floor.drift_x, rolled * floor.drift_y, 0}};
}

double World::State::creeping_load(const Support& s) const {
  return std::max(load(s), kLeastLoad * robot.total_mass_kg() * options.gravity_mps2);
}

// Where a line of width w turns at omega on the floor, its points slide either way, and only what slides more on one
// side than on the other pulls: F = mu N 2 s / (omega w) for a slip s, a compliance omega w / (2 mu N). Where the line
// creeps without sliding it is C v / N instead, and the law goes over from one to the other where they are equal.
double World::State::slip_of_turning_patch(const Support& s, double friction, const Vector3d& normal) const {
  if (s.wheel < 0 || robot.wheels[s.wheel].patch_width_m == 0) return 0;
  const double turning = std::abs(normal.dot(body.velocity().head<3>()));
  return turning * robot.wheels[s.wheel].patch_width_m / (2 * friction * creeping_load(s));
}

// A contact is taken as a line of width w and uniform pressure whose points creep, and slide from mu on. Turning at
// omega while it rolls at v, points slide beyond y = mu C v / omega from its middle. With x that y over w / 2, M is
//   mu N w / 4 times (1 - x^2 / 3) for x < 1, and N w^2 / (12 C) omega / v, where nothing slides, for x > 1,
// less the square of the share of its friction that the contact gives along.
void World::State::add_spin_friction(const DofVector& u, double step_s) {
  for (int i = 0; i < problem.contacts; ++i) {
    const ContactRows& c = problem.contact[i];
    const Support& s = supports[contact_support[i]];
    if (s.wheel < 0 || robot.wheels[s.wheel].patch_width_m == 0) continue;
    const double width_m = robot.wheels[s.wheel].patch_width_m;
    const double creep = tyre_slip(s).along;
    row[rows] = DofVector::Zero(body.dofs());
    row[rows].head<3>() = row[c.normal].segment<3>(3);  // the contact's normal
    const double turning = std::abs(speed_along(row[rows], body.velocity()));
    const double grip_n = c.friction * load(s);
    const double given = grip_n > 0 ? std::min(std::abs(loads.wheel_along_n[s.wheel]) / grip_n, 1.0) : 0;
    const double sticking = 2 * grip_n * creep;  // x = sticking / (omega w)
    const double x = sticking < turning * width_m ? sticking / (turning * width_m) : 0;
    const double limit = grip_n * width_m / 4 * (1 - x * x / 3) * (1 - given * given) * step_s;
    problem.motor[problem.motors++] = {rows, limit};
    compliance[rows] = (kSpinMobility + 12 * creep / (width_m * width_m)) / step_s;
    problem.b[rows] = speed_along(row[rows], u);
    ++rows;
  }
}

}  // namespace umbsim
