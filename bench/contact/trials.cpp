#include "bench/contact/trials.h"

#include <cmath>

#include "effects/contact.h"
#include "effects/floor.h"
#include "effects/geometry.h"
#include "tests/effects/trial_drive.h"

namespace umbsim::contact {
namespace {

using testing::kG;
using testing::kRadius_m;
using testing::kWheelbase_m;
using testing::rig_with;
using testing::Statics;
using testing::TrialDrive;

constexpr double kForce_s = 10;

Rig pushed_rig(double creep, double force_n, double direction_rad) {
  Rig rig = rig_with(TyreCreep{creep, creep});
  rig.pushes.push_back({1, {0, kForce_s, force_n * kForce_s, direction_rad, 0, 0}});
  return rig;
}

// Change of the error over two seconds at 0.2 m/s.
struct Cruise {
  Pose2 added;
  double after_rad = 0;
  double distance_m = 0;
};

Cruise cruise(TrialDrive& drive) {
  drive.ramp(0.2, 0, 1);
  drive.go(0.2, 0, 1);
  const Pose2 before = drive.error();
  const double start_m = drive.odometry.x_m;
  drive.go(0.2, 0, 2);
  const Pose2 after = drive.error();
  return {{after.x_m - before.x_m, after.y_m - before.y_m, after.theta_rad - before.theta_rad}, after.theta_rad,
          drive.odometry.x_m - start_m};
}

}  // namespace

PhysicsOptions with_step(double step_s) {
  PhysicsOptions options;
  options.step_s = step_s;
  options.fine_step_s = std::min(step_s, options.fine_step_s);
  return options;
}

Slip slip_along(double creep, double force_n, const PhysicsOptions& options) {
  const Rig rig = pushed_rig(creep, force_n, 0);
  TrialDrive drive(rig, options);
  const double x_c = rig.robot.casters[0].centre_m.x(), m = rig.robot.total_mass_kg();
  // The force at axle height tips the robot about the wheels' contact line; so does its own acceleration.
  const double wheels_n = Statics(rig.robot).wheels_n - force_n * kRadius_m / x_c;
  const double tip_kgm = rig.robot.base.mass_kg * (kRadius_m + rig.robot.base.com_m.z()) + 2 * kRadius_m;
  const Cruise c = cruise(drive);
  Slip result{force_n / wheels_n, c.added.x_m / c.distance_m, 0, 0, long(drive.world.cost().solver_fallbacks)};
  // From rest at constant acceleration: 6 s^2 a between 2 s and 4 s.
  result.acceleration_mps2 = (c.added.x_m + c.distance_m) / 6;
  if (result.traction > kMu) result.intended_mps2 = (force_n - kMu * wheels_n) / (m + kMu * tip_kgm / x_c);
  return result;
}

Slip slip_across(double creep, double force_n, const PhysicsOptions& options) {
  const Rig rig = pushed_rig(creep, force_n, M_PI / 2);
  TrialDrive drive(rig, options);
  const Cruise c = cruise(drive);
  return {force_n / Statics(rig.robot).wheels_n, c.added.y_m / c.distance_m - c.after_rad, 0, 0,
          long(drive.world.cost().solver_fallbacks)};
}

Figure turn_lost(double creep, double width_m, const PhysicsOptions& options) {
  TrialDrive drive(rig_with(TyreCreep{creep, creep}, ContactPatch{width_m}), options);
  drive.ramp(0, 0.5, 1);
  const double before = drive.error().theta_rad, start_rad = drive.odometry.theta_rad;
  drive.go(0, 0.5, 4);
  const double lost = (before - drive.error().theta_rad) / (drive.odometry.theta_rad - start_rad);
  // Of friction each wheel gives the share `given` along to turn both patches; docs/contact.md has the law.
  double given = 0;
  for (int i = 0; i < 100; ++i) {
    const double x = kMu * creep * (kWheelbase_m / width_m + given);
    given = (given + width_m / (2 * kWheelbase_m) * (1 - x * x / 3) * (1 - given * given)) / 2;
  }
  const double slip = given * width_m / kWheelbase_m;
  return {lost, slip / (1 + slip)};
}

Figure curve_lost(double creep, double width_m, const PhysicsOptions& options) {
  const auto heading = [&](double width) {
    TrialDrive drive(rig_with(TyreCreep{creep, creep}, ContactPatch{width}, WheelRadiusDifference{0.002}), options);
    drive.leg(0.2, 0, 10);
    return drive.error().theta_rad;
  };
  return {1 - heading(width_m) / heading(0), width_m * width_m / (3 * kWheelbase_m * kWheelbase_m)};
}

Figure slope_heading(double creep, double slope_rad, const PhysicsOptions& options) {
  const Rig rig = rig_with(TyreCreep{creep, creep}, FloorSlope{slope_rad, M_PI / 2});
  TrialDrive drive(rig, options);
  const Cruise c = cruise(drive);
  // The weight's slope component acts x_b ahead of the axle: +-m_b g sin(a) x_b / b on each wheel. Loads by roll.
  const double base_kg = rig.robot.base.mass_kg, slide = kG * std::sin(slope_rad), b = kWheelbase_m;
  const double force_n = base_kg * slide * rig.robot.base.com_m.x() / b;
  const double tip_n = (base_kg * (kRadius_m + rig.robot.base.com_m.z()) + 2 * kRadius_m) * slide / b;
  const double half_n = Statics(rig.robot).wheels_n * std::cos(slope_rad) / 2;
  return {c.added.theta_rad / c.distance_m, creep * force_n * (1 / (half_n + tip_n) + 1 / (half_n - tip_n)) / b};
}

Figure compliance(double metres_per_newton, const PhysicsOptions& options) {
  const Rig rig = rig_with(TyreCompliance{metres_per_newton});
  TrialDrive drive(rig, options);
  drive.leg(0.3, 0, 5);
  return {drive.error().x_m / drive.odometry.x_m, -metres_per_newton * Statics(rig.robot).wheels_n / 2 / kRadius_m};
}

Figure drag_yaw(double creep, const PhysicsOptions& options) {
  constexpr double kDrag = 0.03, kLeft_m = 0.05;
  const Rig rig = rig_with(TyreCreep{creep, creep}, CasterDrag{kDrag, kLeft_m});
  TrialDrive drive(rig, options);
  const Cruise c = cruise(drive);
  const Statics load(rig.robot);
  const double drag_n = kDrag * load.caster_n, uneven_n = drag_n * kLeft_m / kWheelbase_m;
  const double left = creep * (drag_n / 2 + uneven_n) / load.left_n;
  const double right = creep * (drag_n / 2 - uneven_n) / load.right_n;
  return {c.added.theta_rad / c.distance_m, (left - right) / kWheelbase_m};
}

Figure carpet(const PhysicsOptions& options) {
  constexpr double kDrift = 0.004;
  TrialDrive drive(rig_with(CarpetDrift{kDrift, M_PI / 2}), options);
  drive.leg(0.2, 0, 4);
  for (int i = 0; i < 4; ++i) drive.leg(0, M_PI / 8, 3);
  return {drive.error().y_m / drive.rolled_m, kDrift};
}

double swivel_kick(const PhysicsOptions& options) {
  TrialDrive drive(rig_with(TyreCreep{0.02, 0.02}, CasterSwivel{0.03, 0.2, 0}), options);
  drive.leg(0, M_PI / 4, 1);
  const double before_rad = drive.error().theta_rad;
  drive.leg(0.1, 0, 5);
  return drive.error().theta_rad - before_rad;
}

}  // namespace umbsim::contact
