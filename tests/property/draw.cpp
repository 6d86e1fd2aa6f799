#include "tests/property/draw.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/random.h"
#include "effects/catalogue.h"

namespace umbsim::property {
namespace {

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : random_(seed, "property") {}
  double between(double low, double high) { return random_.uniform(low, high); }
  double log_between(double low, double high) { return low * std::exp(between(0, std::log(high / low))); }
  bool chance(double share) { return between(0, 1) < share; }
  std::size_t below(std::size_t count) { return std::size_t(between(0, double(count))); }

 private:
  RandomStream random_;
};

// Mostly as on real robots, sometimes anything that is accepted.
double parameter(Dice& dice, const EffectParameter& p) {
  const bool bounded = std::isfinite(p.bounds.min) && std::isfinite(p.bounds.max);
  double value = bounded && dice.chance(0.2) ? dice.between(p.bounds.min, p.bounds.max)
                                             : dice.between(p.plausible_min, p.plausible_max);
  if (p.bounds.contains(-value) && dice.chance(0.5)) value = -value;
  return p.bounds.contains(value) ? value : p.typical;
}

std::string effects(Dice& dice) {
  std::string text;
  std::vector<std::string> used;
  for (std::size_t i = dice.below(4); i > 0; --i) {
    const EffectInfo& info = catalogue()[dice.below(catalogue().size())];
    if (std::find(used.begin(), used.end(), info.name) != used.end()) continue;
    used.push_back(info.name);
    text += fmt::format("  {}: {{", info.name);
    for (std::size_t k = 0; k < info.parameters.size(); ++k) {
      text += fmt::format("{}{}: {:.9g}", k ? ", " : "", info.parameters[k].name, parameter(dice, info.parameters[k]));
    }
    text += info.one_run ? fmt::format("{}run: cw-1}}\n", info.parameters.empty() ? "" : ", ") : "}\n";
  }
  return text.empty() ? "effects: {}\n" : "effects:\n" + text;
}

std::string noise(Dice& dice) {
  std::string text = "noise: {";
  if (dice.chance(0.4)) {
    text += fmt::format("floor_rms_m: {:.6g}, floor_wavelength_m: {:.6g}, ", dice.log_between(1e-5, 0.02),
                        dice.log_between(0.02, 10));
  }
  if (dice.chance(0.4)) text += fmt::format("radius_scatter: {:.6g}, ", dice.log_between(1e-6, 0.1));
  if (dice.chance(0.3)) text += fmt::format("motor_scatter: {:.6g}, ", dice.log_between(1e-6, 0.1));
  if (dice.chance(0.2)) text += fmt::format("wheel_noise_m_per_sqrt_m: {:.6g}, ", dice.log_between(1e-5, 0.005));
  return text + "}\n";
}

std::string course(Dice& dice, double side_m) {
  const bool arc = dice.chance(0.3);
  return fmt::format(
      "course: {{side_m: {:.6g}, turn: {}, turn_radius_m: {:.6g}, linear_speed_mps: {:.6g}, angular_speed_radps: "
      "{:.6g}, "
      "linear_acceleration_mps2: {:.6g}, angular_acceleration_radps2: {:.6g}, dwell_s: {:.6g}}}\n",
      side_m, arc ? "arc" : "in_place", dice.between(0.05, 0.45) * side_m, dice.log_between(0.05, 10),
      dice.log_between(0.2, 20), dice.log_between(0.05, 20), dice.log_between(0.1, 50), dice.between(0, 0.5));
}

}  // namespace

Drawn draw(std::uint64_t seed) {
  Dice dice(seed);
  const char* const kRobots[] = {"labmate.urdf", "optiodom.urdf"};
  const bool plain = dice.chance(0.25);
  Drawn drawn;
  drawn.mirrored = plain;
  drawn.yaml = fmt::format("format: umbsim-scenario/1\nname: property-{}\nseed: {}\n", seed, seed);
  drawn.yaml += fmt::format("robot: {{urdf: {}}}\n", plain ? kRobots[0] : kRobots[dice.below(2)]);
  drawn.yaml += fmt::format("encoders: {{ticks_per_revolution: {:.6g}, rate_hz: {:.4g}}}\n", dice.log_between(10, 1e6),
                            dice.log_between(1, 300));
  drawn.yaml += fmt::format("floor: {{friction: {:.4g}}}\n", dice.log_between(0.02, 5));
  drawn.yaml += course(dice, dice.log_between(0.1, 2));
  drawn.yaml += "runs: {per_direction: 1}\n";
  if (!plain) drawn.yaml += noise(dice);
  drawn.yaml += fmt::format("truth: {{kind: {}, rate_hz: {:.4g}}}\n", dice.chance(0.5) ? "track" : "endpoints",
                            dice.log_between(1, 100));
  drawn.yaml += fmt::format("calibration: {{method: {}, max_passes: 1}}\n", dice.chance(0.5) ? "none" : "heading");
  drawn.yaml +=
      fmt::format("physics: {{step_s: {:.4g}, fine_step_s: {:.4g}, static_sink_m: {:.4g}, damping_ratio: {:.4g}}}\n",
                  dice.log_between(0.002, 0.05), dice.log_between(0.001, 0.01),
                  dice.chance(0.2) ? 0 : dice.log_between(1e-5, 0.01), dice.log_between(0.1, 10));
  if (!plain && dice.chance(0.2)) {
    drawn.yaml += fmt::format("bumps: {{leg: {}, count: {}, height_m: {:.4g}}}\n", 1 + dice.below(4), dice.below(4),
                              dice.log_between(0.001, 0.05));
  }
  drawn.yaml += plain ? "effects: {}\n" : effects(dice);
  return drawn;
}

}  // namespace umbsim::property
