#include "experiment/drive/rolling_noise.h"

#include <algorithm>
#include <cmath>

namespace umbsim {
namespace {

// Grains are at least this long: shorter ones would need rolling radii that no wheel has.
constexpr double kGrain_m = 0.001;

}  // namespace

RollingNoise::RollingNoise(double k_m_per_sqrt_m, const Rig& rig)
    : k_m_per_sqrt_m_(k_m_per_sqrt_m),
      grains_{Grain{RandomStream(rig.run.seed, "left rolling", std::uint64_t(rig.run.number)),
                    rig.robot.wheels[0].radius_m},
              Grain{RandomStream(rig.run.seed, "right rolling", std::uint64_t(rig.run.number)),
                    rig.robot.wheels[1].radius_m}} {}

// A grain of length l whose relative radius has the variance k^2 / l adds k^2 l to the variance of the path. A wheel
// that rolls c instead of l on it got k^2 c^2 / l where k^2 c is due; the next grain pays the difference, as far as it
// can with twice its own share.
void RollingNoise::next_grain(Grain& g, double planned_m) const {
  g.owed_m += g.rolled_m - g.granted_1pm * g.rolled_m * g.rolled_m;
  g.rolled_m = 0;
  g.length_m = std::max(planned_m, kGrain_m);
  g.granted_1pm = std::clamp(g.length_m + g.owed_m, 0.0, 2 * g.length_m) / (g.length_m * g.length_m);
}

const std::array<double, 2>& RollingNoise::next(const std::array<double, 2>& wheel_rad, const WheelSpeeds& command,
                                                double period_s) {
  if (k_m_per_sqrt_m_ == 0) return factors_;
  const double speed_radps[2] = {command.left_radps, command.right_radps};
  for (std::size_t i = 0; i < 2; ++i) {
    Grain& g = grains_[i];
    g.rolled_m += std::abs(wheel_rad[i] - g.angle_rad) * g.radius_m;
    g.angle_rad = wheel_rad[i];
    const double planned_m = std::abs(speed_radps[i]) * period_s * g.radius_m;
    if (g.rolled_m + planned_m / 2 < g.length_m) continue;
    next_grain(g, planned_m);
    factors_[i] = 1 + k_m_per_sqrt_m_ * std::sqrt(g.granted_1pm) * g.random.normal();
  }
  return factors_;
}

void RollingNoise::roughen(World& world, const WheelSpeeds& command, double period_s) {
  if (k_m_per_sqrt_m_ == 0) return;
  next({world.wheel_angle(0), world.wheel_angle(1)}, command, period_s);
  for (int i = 0; i < 2; ++i) world.scale_rolling_radius(i, factors_[std::size_t(i)]);
}

}  // namespace umbsim
