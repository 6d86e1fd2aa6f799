#include "effects/floor.h"

#include <cmath>

namespace umbsim {

void apply(const SlipperyFloor& effect, Rig& rig) {
  if (effect.friction > 0) rig.floor.friction = effect.friction;
}

void apply(const SlipperyPatch& effect, Rig& rig) {
  if (effect.radius_m > 0) rig.floor.patches.push_back({effect.x_m, effect.y_m, effect.radius_m, effect.friction});
}

void apply(const Bump& effect, Rig& rig) {
  if (effect.height_m <= 0) return;
  rig.floor.cables.push_back({effect.x_m, effect.y_m, effect.direction_rad, effect.height_m, effect.length_m});
}

void apply(const UnevenFloor& effect, Rig& rig) {
  if (effect.rms_m <= 0) return;
  for (const Ripple& r : random_ripples(effect.rms_m, effect.wavelength_m, std::uint64_t(effect.seed), 0)) {
    rig.floor.ripples.push_back(r);
  }
}

void apply(const FloorSlope& effect, Rig& rig) {
  rig.floor.slope_rad = effect.slope_rad;
  rig.floor.downhill_rad = effect.downhill_rad;
}

void apply(const CarpetDrift& effect, Rig& rig) {
  rig.floor.drift_x += effect.metres_per_metre * std::cos(effect.direction_rad);
  rig.floor.drift_y += effect.metres_per_metre * std::sin(effect.direction_rad);
}

void apply(const PushEffect& effect, Rig& rig) {
  if (effect.impulse_newton_seconds == 0) return;
  if (!effect.run.empty() && effect.run != rig.run.id) return;
  Push push{effect.seconds_into_leg, effect.duration_s, effect.impulse_newton_seconds,
            effect.direction_rad,    effect.ahead_m,    0};
  rig.pushes.push_back({int(std::lround(effect.leg)), push});
}

void apply(const WheelLift& effect, Rig& rig) {
  if (effect.length_m > 0) rig.floor.patches.push_back({effect.x_m, effect.y_m, effect.length_m / 2, 0});
}

}  // namespace umbsim
