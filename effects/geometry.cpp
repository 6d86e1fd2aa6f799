#include "effects/geometry.h"

#include <Eigen/Geometry>


namespace umbsim {
namespace {

// Inertia of a wheel of the same mass goes with the square of its radius.
void scale_radius(Wheel& wheel, double factor) {
  wheel.radius_m *= factor;
  wheel.spin_inertia_kgm2 *= factor * factor;
  wheel.transverse_inertia_kgm2 *= factor * factor;
}

}  // namespace

void apply(const WheelRadiusScale& effect, Rig& rig) {
  for (Wheel& wheel : rig.robot.wheels) scale_radius(wheel, 1 + effect.relative);
}

void apply(const WheelRadiusDifference& effect, Rig& rig) {
  scale_radius(rig.robot.wheels[0], 2 / (2 + effect.relative));
  scale_radius(rig.robot.wheels[1], 2 * (1 + effect.relative) / (2 + effect.relative));
}

void apply(const Wheelbase& effect, Rig& rig) {
  for (Wheel& wheel : rig.robot.wheels) wheel.centre_m *= 1 + effect.relative;
}

void apply(const WheelMisalignment& effect, Rig& rig) {
  const double toe_rad[] = {effect.left_toe_rad, effect.right_toe_rad};
  for (int i = 0; i < 2; ++i) {
    if (toe_rad[i] == 0) continue;
    Wheel& wheel = rig.robot.wheels[i];
    wheel.axis = Eigen::AngleAxisd(toe_rad[i], Eigen::Vector3d::UnitZ()) * wheel.axis;
  }
}

void apply(const WheelEccentricity& effect, Rig& rig) {
  rig.robot.wheels[0].eccentricity_m = effect.left_m;
  rig.robot.wheels[0].eccentricity_rad = effect.left_phase_rad;
  rig.robot.wheels[1].eccentricity_m = effect.right_m;
  rig.robot.wheels[1].eccentricity_rad = effect.right_phase_rad;
}

// Lumps the point mass into the base: centre of mass, and inertia about it (parallel axes).
void apply(const LoadShift& effect, Rig& rig) {
  if (effect.payload_kg == 0) return;
  Inertial& base = rig.robot.base;
  const Eigen::Vector3d place(effect.ahead_m, effect.left_m, effect.height_m);
  const double mass_kg = base.mass_kg + effect.payload_kg;
  const Eigen::Vector3d com = (base.mass_kg * base.com_m + effect.payload_kg * place) / mass_kg;
  const auto point = [](double mass, const Eigen::Vector3d& r) -> Eigen::Matrix3d {
    return mass * (r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose());
  };
  base.inertia_kgm2 += point(base.mass_kg, base.com_m - com) + point(effect.payload_kg, place - com);
  base.com_m = com;
  base.mass_kg = mass_kg;
}

void apply(const Wear& effect, Rig& rig) {
  const double rate[] = {effect.left_relative_per_run, effect.right_relative_per_run};
  for (int i = 0; i < 2; ++i) {
    if (rate[i] != 0) scale_radius(rig.robot.wheels[i], 1 + rate[i] * rig.run.number);
  }
}

}  // namespace umbsim
