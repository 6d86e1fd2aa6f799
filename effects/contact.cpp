#include "effects/contact.h"

namespace umbsim {
namespace {

// Of the swivelling part, relative to the robot: fork and wheel of a caster of this size are light.
constexpr double kForkShare = 0.01;
constexpr double kWheelShare = 0.005;

}  // namespace

void apply(const TyreCompliance& effect, Rig& rig) {
  for (Wheel& wheel : rig.robot.wheels) wheel.compliance_mpn = effect.metres_per_newton;
}

void apply(const ContactPatch& effect, Rig& rig) {
  for (Wheel& wheel : rig.robot.wheels) wheel.patch_width_m = effect.width_m;
}

void apply(const TyreCreep& effect, Rig& rig) {
  for (Wheel& wheel : rig.robot.wheels) {
    wheel.creep_along = effect.along;
    wheel.creep_across = effect.across;
    wheel.slip_along_mps_per_n = effect.slip_along_mps_per_n;
    wheel.slip_across_mps_per_n = effect.slip_across_mps_per_n;
  }
}

// The swivel axis stands where the ball was; the wheel of the ball's radius follows `trail_m` behind it.
void apply(const CasterSwivel& effect, Rig& rig) {
  if (effect.trail_m <= 0 || rig.robot.casters.empty()) return;
  const double robot_kg = rig.robot.total_mass_kg();
  Caster& c = rig.robot.casters.front();
  if (!c.swivels) {
    const double fork_kg = kForkShare * robot_kg, wheel_kg = kWheelShare * robot_kg;
    const double r2 = c.radius_m * c.radius_m;
    c.swivels = true;
    c.swivel_point_m = c.centre_m;
    c.fork = {fork_kg, c.centre_m, Eigen::Matrix3d(fork_kg * r2 * Eigen::Matrix3d::Identity())};
    c.wheel_mass_kg = wheel_kg;
    c.wheel_spin_inertia_kgm2 = wheel_kg * r2 / 2;
    c.wheel_transverse_inertia_kgm2 = wheel_kg * r2 / 4;
  }
  const double height_m = c.centre_m.z();  // the swivel point is anywhere on its axis
  c.centre_m = c.swivel_point_m - Eigen::Vector3d(effect.trail_m, 0, 0);
  c.centre_m.z() = height_m;
  c.swivel_friction_nm = effect.friction_nm;
  c.initial_angle_rad = effect.initial_angle_rad;
  c.bearing_creep = effect.bearing_creep;
}

void apply(const CasterDrag& effect, Rig& rig) {
  for (Caster& c : rig.robot.casters) {
    if (c.swivels) continue;
    c.friction += effect.coefficient;
    c.centre_m.y() += effect.left_m;
  }
}

}  // namespace umbsim
