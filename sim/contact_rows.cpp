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
// Rims off their centres touch the floor at unequal heights below the axle: as the robot leans they squeeze each other,
// at microns per second. Tyres give that elastically; rigid ones would jam, and slide at their full friction.
constexpr double kSqueezeMobility = 1e-8;  // m/s per N

// row . u, with the size known when compiling where it is the usual one.
double speed_along(const DofVector& row, const DofVector& u) {
  return row.size() == 8 ? row.head<8>().dot(u.head<8>()) : row.dot(u);
}

}  // namespace

// All contacts of a step, and a row of the general step for each of their directions. `found`: find_contacts() has
// them.
void World::State::add_contacts(double step_s, const DofVector& u, const std::array<double, 2>& target_radps,
                                bool found) {
  if (!found) find_contacts(step_s, kSpeculative_m + step_s * u.segment<3>(3).norm(), 0, expected_radps(target_radps));
  rows = 0;
  problem.contacts = problem.motors = 0;
  problem.b.resize(kMaxRows);
  for (int i = 0; i < contacts; ++i) add_contact_rows(contact[i], u);
  add_spin_friction(u, step_s);
}

// Supports whose gap is less than `watch_m`. Another that is less than `doubt_m` above this makes the set doubtful.
void World::State::find_contacts(double step_s, double watch_m, double doubt_m,
                                 const std::array<double, 2>& wheel_radps) {
  contacts = 0;
  doubtful = false;
  spinning_radps = wheel_radps;
  const Matrix3d R_BW = body.rotation().transpose();
  const bool plain = floor.ripples.empty() && floor.cables.empty() && floor.patches.empty();
  for (int i = 0; i < int(supports.size()); ++i) {
    const Support& s = supports[i];
    const Joint hinge = s.joint >= 0 ? body.current(s.joint) : Joint{-1, s.centre_m, Vector3d::Zero()};
    // A wheel that hangs comes down.
    const double hanging_m = sprung ? step_s * std::abs(spring_speed(s, 0, step_s)) : 0;
    const auto watch = [&](double gap_m, const Vector3d& normal, double friction) {
      if (contacts == 8) return;
      if (gap_m < watch_m + hanging_m)
        add_contact(i, hinge, normal, gap_m, friction, step_s, wheel_radps);
      else
        doubtful = doubtful || gap_m < watch_m + hanging_m + doubt_m;
    };
    if (plain) {
      const Vector3d up = R_BW.col(2);
      const double centre_m = body.position().z() + up.dot(rim_centre(s, hinge) + shift(s));
      const double leaning = up.dot(hinge.axis);
      watch(centre_m - outer_radius(s) * (s.disc ? std::sqrt(1 - leaning * leaning) : 1), up, floor.friction);
      continue;
    }
    const RollingShape round = shape(s);
    const NearestPoint ground = nearest_on_floor(floor, round);
    watch(ground.distance_m, R_BW * ground.normal, friction_at(floor, ground.point_m.x(), ground.point_m.y()));
    for (const Cable& cable : floor.cables) {
      NearestPoint nearest;
      const double reach_m = round.radius_m + cable.length_m + cable.height_m;
      if (std::hypot(round.centre_m.x() - cable.x_m, round.centre_m.y() - cable.y_m) > reach_m) continue;
      if (contacts == 8 || !nearest_on_cable(floor, cable, round, nearest)) continue;
      if (nearest.distance_m < watch_m)
        add_contact(i, hinge, R_BW * nearest.normal, nearest.distance_m,
                    friction_at(floor, nearest.point_m.x(), nearest.point_m.y()), step_s, wheel_radps);
      else
        doubtful = doubtful || nearest.distance_m < watch_m + doubt_m;
    }
  }
}

// Unilateral row. A gap may close within the step but not become negative. In contact the row is a spring and damper
// taken implicitly: impulse x = h (k (sink - h v) - d v), that is v + x / (h (h k + d)) = sink k / (h k + d).
// Friction rows along the wheel's rolling direction and across it, at the rolling radius. An eccentric rim is taken
// where it is in the middle of the step: its way round the axle is then exact to second order.
void World::State::add_contact(int support, const Joint& hinge, const Vector3d& normal, double gap_m,
                               double floor_friction, double step_s, const std::array<double, 2>& wheel_radps) {
  const Support& s = supports[support];
  Contact& c = contact[contacts++];
  c.support = support;
  c.friction = s.friction_scale * floor_friction + s.own_friction;
  soften_contact(c, gap_m, step_s);
  c.direction[0] = normal;
  if (!s.disc && c.friction <= 0) {  // a ball that does not drag
    c.lever = body.lever(-1, s.centre_m - s.radius_m * normal + shift(s));
    for (int i = 1; i < 3; ++i) c.direction[i].setZero(), c.compliance[i] = 0;
    return;
  }
  const Vector3d axis = s.joint >= 0 ? hinge.axis : Vector3d(Vector3d::UnitY());
  const Vector3d level = axis.cross(normal);
  const double leaning = axis.dot(normal), share = 1 / level.norm();
  c.direction[1] = share * level;
  c.direction[2] = normal.cross(c.direction[1]);
  const Vector3d towards = s.disc ? Vector3d(share * (leaning * axis - normal)) : Vector3d(-normal);
  const double half_step_rad = s.wheel >= 0 ? 0.5 * step_s * wheel_radps[s.wheel] : 0;
  const Vector3d rim = rim_centre(s, hinge, half_step_rad) + rolling_radius(s) * towards + shift(s);
  c.lever = body.lever(s.joint, rim, shift(s));
  if (c.friction <= 0) return;
  const TyreSlip slip = tyre_slip(s);
  c.compliance[1] = (kMobility + std::max(slip.along, slip_of_turning_patch(s, c.friction, normal))) / step_s;
  c.compliance[2] = ((off_centre() ? kSqueezeMobility : kMobility) + slip.across) / step_s;
  c.offset[1] = c.offset[2] = 0;
  if (floor.drift_x == 0 && floor.drift_y == 0) return;
  const Eigen::AngleAxisd back(-0.5 * step_s * turning_radps(normal), normal);  // as seen in the middle of the step
  const Vector3d surface = back * (body.rotation().transpose() * slip.surface_mps);
  for (int i = 1; i < 3; ++i) c.offset[i] = -surface.dot(c.direction[i]);
}

void World::State::soften_contact(Contact& c, double gap_m, double step_s) const {
  const Support& s = supports[c.support];
  const double spring = step_s * s.stiffness_npm + s.damping_nspm;
  const bool soft = s.stiffness_npm > 0;
  c.compliance[0] = soft ? 1 / (step_s * spring) : kMobility / step_s;
  c.offset[0] = soft && gap_m < 0 ? gap_m * s.stiffness_npm / spring : gap_m / step_s;
}

void World::State::add_contact_rows(const Contact& c, const DofVector& u) {
  problem.contact[problem.contacts] = {rows, c.friction};
  contact_support[problem.contacts++] = c.support;
  for (int i = 0; i < (c.friction > 0 ? 3 : 1); ++i, ++rows) {
    body.jacobian(c.lever, c.direction[i], row[rows]);
    compliance[rows] = c.compliance[i];
    problem.b[rows] = speed_along(row[rows], u) + c.offset[i];
  }
}

// Creep before sliding is a speed proportional to rolling speed and traction ratio: slip = C v F / N (linear theory,
// e.g. Johnson, Contact Mechanics, 8.3), hence a compliance C v / N of the friction rows. Slip at any speed is a
// compliance of its own: a speed per force, as engines have it whose friction is a damper. Carpet carries the robot in
// proportion to the distance that it rolls.
TyreSlip World::State::tyre_slip(const Support& s) const {
  if (s.wheel < 0) return {};
  const Wheel& w = robot.wheels[s.wheel];
  if (!w.gives_way() && floor.drift_x == 0 && floor.drift_y == 0) return {};
  const double speed = std::abs(body.velocity()[6 + s.wheel]) * w.radius_m;
  const double rolled = (std::abs(spinning_radps[0]) + std::abs(spinning_radps[1])) / 2 * w.radius_m;  // by the robot
  const double load_n = creeping_load(s);
  return {w.creep_along * speed / load_n + w.slip_along_mps_per_n,
          w.creep_across * speed / load_n + w.slip_across_mps_per_n,
          {rolled * floor.drift_x, rolled * floor.drift_y, 0}};
}

double World::State::creeping_load(const Support& s) const {
  return std::max(load(s), kLeastLoad * robot.total_mass_kg() * options.gravity_mps2);
}

// How fast the robot turns about the normal: as in the step before, and as much faster as its wheels turn now.
double World::State::turning_radps(const Vector3d& normal) const {
  const DofVector& u = body.velocity();
  double more_mps = 0;
  for (std::size_t i = 0; i < 2; ++i)
    more_mps += (i == 0 ? -1 : 1) * robot.wheels[i].radius_m * (spinning_radps[i] - u[6 + Eigen::Index(i)]);
  return normal.dot(u.head<3>()) + more_mps / robot.wheelbase_m();
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
TurningPatch World::State::turning_patch(const Contact& c, double step_s) const {
  const Support& s = supports[c.support];
  if (s.wheel < 0 || robot.wheels[s.wheel].patch_width_m == 0) return {};
  const double width_m = robot.wheels[s.wheel].patch_width_m;
  const double creep = tyre_slip(s).along;
  const double turning = std::abs(c.direction[0].dot(body.velocity().head<3>()));
  const double grip_n = c.friction * load(s);
  const double given = grip_n > 0 ? std::min(std::abs(loads.wheel_along_n[s.wheel]) / grip_n, 1.0) : 0;
  const double sticking = 2 * grip_n * creep;  // x = sticking / (omega w)
  const double x = sticking < turning * width_m ? sticking / (turning * width_m) : 0;
  return {true, grip_n * width_m / 4 * (1 - x * x / 3) * (1 - given * given) * step_s,
          (kSpinMobility + 12 * creep / (width_m * width_m)) / step_s};
}

void World::State::add_spin_friction(const DofVector& u, double step_s) {
  for (int i = 0; i < contacts; ++i) {
    const TurningPatch patch = turning_patch(contact[i], step_s);
    if (!patch.turns) continue;
    row[rows] = DofVector::Zero(body.dofs());
    row[rows].head<3>() = contact[i].direction[0];
    problem.motor[problem.motors++] = {rows, patch.limit};
    compliance[rows] = patch.compliance;
    problem.b[rows] = speed_along(row[rows], u);
    ++rows;
  }
}

}  // namespace umbsim
