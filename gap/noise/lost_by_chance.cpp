#include "gap/noise/lost_by_chance.h"

#include <algorithm>
#include <cmath>

#include "gap/traits/traits.h"

namespace umbsim::gap {
namespace {

// Of a wheel where it rolls, on the mean over its way.
double mean_speed_radps(const NominalReplay& n, std::size_t wheel) {
  double way_m = 0;
  double way_by_speed = 0;
  for (std::size_t r = 0; r < n.runs(); ++r) {
    const auto& truth = n.recording->runs[r].truth;
    for (std::size_t k = 1; k < n.wheels_m[r].size(); ++k) {
      const double step_m = std::abs(n.wheels_m[r][k][wheel]);
      const double step_s = truth[k].time_s - truth[k - 1].time_s;
      if (step_s <= 0) continue;
      way_m += step_m;
      way_by_speed += step_m * step_m / step_s;
    }
  }
  return way_m > 0 ? way_by_speed / way_m / n.recording->robot.wheel_radius_m : 0;
}

}  // namespace

NoiseModel lost_by_chance(const NominalReplay& nominal, const std::vector<Effect>& effects) {
  NoiseModel noise;
  noise.heading_rad2_pm = noise.along_m2_pm = 0;
  for (const Effect& effect : effects) {
    if (!is(effect.info->name, kByChance)) continue;
    const EncoderSpec encoders = apply_effects({effect}, Rig{}).encoders;
    const RecordedRobot& robot = nominal.recording->robot;
    const double count_m = 2 * M_PI * robot.wheel_radius_m / robot.ticks_per_revolution;
    const EncoderFaults faults[] = {encoders.left, encoders.right};
    double lost = 0;
    for (std::size_t wheel = 0; wheel < 2; ++wheel) {
      const EncoderFaults& f = faults[wheel];
      const double of_speed = f.missed_probability_per_radps * mean_speed_radps(nominal, wheel);
      const double p = std::min(1.0, f.missed_probability + of_speed);
      lost += p * (1 - p);
    }
    noise.heading_rad2_pm += lost * count_m / (robot.wheelbase_m * robot.wheelbase_m);
    noise.along_m2_pm += lost * count_m / 4;
  }
  return noise;
}

}  // namespace umbsim::gap
