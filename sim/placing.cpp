#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "sim/world_state.h"

namespace umbsim {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

Quaterniond upright(double heading_rad, double roll_rad, double pitch_rad) {
  return Quaterniond(Eigen::AngleAxisd(heading_rad, Vector3d::UnitZ())) *
         Quaterniond(Eigen::AngleAxisd(pitch_rad, Vector3d::UnitY())) *
         Quaterniond(Eigen::AngleAxisd(roll_rad, Vector3d::UnitX()));
}

// Of tyre and spring, one after the other.
double stiffness_of(const Support& s) {
  constexpr double kRigid_npm = 1e9;
  const double tyre = s.stiffness_npm > 0 ? s.stiffness_npm : kRigid_npm;
  return s.spring.sprung() ? 1 / (1 / tyre + 1 / s.spring.stiffness_npm) : tyre;
}

}  // namespace

// Height, roll and pitch at which all supports touch (Gauss-Newton; exact for three supports). On springs: at which
// these balance, which is least squares with their stiffness as weights.
void World::State::place_on_floor(const Pose2& X_WB) {
  Eigen::VectorXd weight = Eigen::VectorXd::Ones(Eigen::Index(supports.size()));
  for (std::size_t i = 0; i < supports.size(); ++i) {
    Support& s = supports[i];
    s.up_m = s.up_mps = 0;
    s.stop = 0;
    if (sprung) weight[Eigen::Index(i)] = std::sqrt(stiffness_of(s));
  }
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
    const Vector3d change =
        sprung ? Vector3d((weight.asDiagonal() * slope).colPivHouseholderQr().solve(weight.cwiseProduct(gap)))
               : Vector3d(slope.colPivHouseholderQr().solve(gap));
    q -= change;
    if (change.norm() < 1e-14) break;
  }
  const Eigen::VectorXd gap = gaps(q);
  if (!sprung) return;
  double inside_m = 0;  // that a support would lie in the floor, beyond its stop
  for (std::size_t i = 0; i < supports.size(); ++i) {
    Support& s = supports[i];
    const double up_m = -gap[Eigen::Index(i)];
    if (s.spring.sprung()) s.up_m = std::clamp(up_m, -s.spring.down_m, s.spring.up_m);
    inside_m = std::max(inside_m, up_m - s.up_m);
  }
  body.set_pose(body.orientation(), body.position() + Vector3d(0, 0, inside_m));
}

// Gives every support the spring and damper that sinks by the stated amount under its load at rest on a flat floor.
void World::State::soften() {
  const double sink_m = options.softness.static_sink_m;
  if (sink_m <= 0) {
    set_gravity();
    return;
  }
  const auto give = [&](Support& s, double load_n) {
    const double load = std::max(load_n, 0.05 * robot.total_mass_kg() * options.gravity_mps2);
    s.sink_m = sink_m;
    s.stiffness_npm = load / sink_m;
    // 2 zeta sqrt(k m) with m the load's mass
    s.damping_nspm = 2 * options.softness.damping_ratio * load / std::sqrt(options.gravity_mps2 * sink_m);
  };
  if (sprung) {
    set_gravity();
    for (Support& s : supports) give(s, s.spring.rest_load_n);
    return;
  }
  Floor flat;
  std::swap(floor, flat);
  set_gravity();
  place_on_floor({});
  for (int i = 0; i < 3; ++i) step(options.fine_step_s, {0, 0});
  std::swap(floor, flat);
  set_gravity();
  for (std::size_t i = 0; i < supports.size(); ++i) {
    give(supports[i], i < 2 ? loads.wheel_n[i] : loads.caster_n[i - 2]);
  }
}

void World::State::check_loads() const {
  for (std::size_t i = 0; i < supports.size(); ++i) {
    const double load = i < 2 ? loads.wheel_n[i] : loads.caster_n[i - 2];
    // On springs a support may hang over a hollow, as long as the others hold the robot.
    const bool must_carry = sprung ? !stands() : i < 2 || supports.size() == 3;
    if (load > 0 || !must_carry) continue;
    throw InputError(fmt::format(
        "{}: the robot does not stand: after settling its {} carries no load (left wheel {:.1f} N, right wheel {:.1f} "
        "N). The centre of mass must lie between the drive wheels and the casters.",
        robot.urdf, supports[i].name, loads.wheel_n[0], loads.wheel_n[1]));
  }
}

}  // namespace umbsim
