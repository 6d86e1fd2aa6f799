#include <cmath>

#include "sim/world_state.h"

namespace umbsim {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kSpeculative_m = 0.001;  // contacts this far ahead are watched, beyond what the step can travel

}  // namespace

void World::State::add_contacts(double step_s, const DofVector& u) {
  rows = 0;
  problem.contacts = problem.motors = 0;
  problem.b.resize(kMaxRows);
  const double watch_m = kSpeculative_m + step_s * u.segment<3>(3).norm();
  for (int i = 0; i < int(supports.size()); ++i) {
    const RollingShape round = shape(supports[i]);
    const NearestPoint ground = nearest_on_floor(floor, round);
    if (ground.distance_m < watch_m) add_contact(i, ground, step_s, u);
    for (const Cable& cable : floor.cables) {
      NearestPoint nearest;
      const double reach_m = round.radius_m + cable.length_m + cable.height_m;
      if (std::hypot(round.centre_m.x() - cable.x_m, round.centre_m.y() - cable.y_m) > reach_m) continue;
      if (nearest_on_cable(floor, cable, round, nearest) && nearest.distance_m < watch_m && problem.contacts < 8) {
        add_contact(i, nearest, step_s, u);
      }
    }
  }
}

// Unilateral row. A gap may close within the step but not become negative. In contact the row is a spring and damper
// taken implicitly: impulse x = h (k (sink - h v) - d v), that is v + x / (h (h k + d)) = sink k / (h k + d).
// Friction rows along the wheel's rolling direction and across it, at the rolling radius.
void World::State::add_contact(int support, const NearestPoint& nearest, double step_s, const DofVector& u) {
  const Support& s = supports[support];
  const Matrix3d R_BW = body.rotation().transpose();
  const Vector3d normal = R_BW * nearest.normal;
  const Joint hinge = s.joint >= 0 ? body.current(s.joint) : Joint{-1, s.centre_m, Vector3d::UnitY()};
  const Vector3d& axis = hinge.axis;
  const Vector3d lever = -s.radius_m * (s.disc ? (normal - axis * axis.dot(normal)).normalized() : normal);
  const Vector3d rim = hinge.pivot_m + lever;
  const double friction = s.friction_scale * floor.friction + s.own_friction;
  problem.contact[problem.contacts] = {rows, friction};
  contact_support[problem.contacts++] = support;

  const double spring = step_s * s.stiffness_npm + s.damping_nspm;
  const bool soft = s.stiffness_npm > 0;
  const double gap_m = nearest.distance_m;
  body.jacobian(s.joint, rim, normal, row[rows]);
  compliance[rows] = soft ? 1 / (step_s * spring) : kMobility / step_s;
  problem.b[rows] = row[rows].dot(u) + (soft && gap_m < 0 ? gap_m * s.stiffness_npm / spring : gap_m / step_s);
  ++rows;
  if (friction <= 0) return;
  const Vector3d along = axis.cross(normal).normalized();
  const Vector3d across = normal.cross(along);
  for (const Vector3d& direction : {along, across}) {
    body.jacobian(s.joint, rim, direction, row[rows]);
    compliance[rows] = kMobility / step_s;
    problem.b[rows] = row[rows].dot(u);
    ++rows;
  }
}

}  // namespace umbsim
