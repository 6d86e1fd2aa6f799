#include "effects/geometry.h"

namespace umbsim {
namespace {

// Inertia of a wheel of the same mass goes with the square of its radius.
void scale_radius(Wheel& wheel, double factor) {
  wheel.radius_m *= factor;
  wheel.spin_inertia_kgm2 *= factor * factor;
  wheel.transverse_inertia_kgm2 *= factor * factor;
}

}  // namespace

void apply(const WheelRadiusDifference& effect, Rig& rig) {
  scale_radius(rig.robot.wheels[0], 2 / (2 + effect.relative));
  scale_radius(rig.robot.wheels[1], 2 * (1 + effect.relative) / (2 + effect.relative));
}

void apply(const WheelRadiusScale& effect, Rig& rig) {
  for (Wheel& wheel : rig.robot.wheels) scale_radius(wheel, 1 + effect.relative);
}

void apply(const Wheelbase& effect, Rig& rig) {
  for (Wheel& wheel : rig.robot.wheels) wheel.centre_m *= 1 + effect.relative;
}

}  // namespace umbsim
