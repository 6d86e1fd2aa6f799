#include "bench/standing/draw.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "core/random.h"
#include "experiment/robot/understood.h"

namespace umbsim {
namespace {

namespace fs = std::filesystem;

constexpr double kReserve = 0.9;

// Its wheels are meshes that do not come with the file; the radius is its joints' height.
void give_size(Scenario& s) {
  if (s.robot.urdf.find("stretch_re1") != std::string::npos) s.robot.wheel_size = {0.0508, 0.03};
}

double log_uniform(RandomStream& random, double low, double high) {
  return low * std::exp(random.uniform(0, std::log(high / low)));
}

// Effects with one number whose plausible range is known, in it.
void draw_effects(Scenario& s, RandomStream& random) {
  std::vector<const EffectInfo*> choices;
  for (const EffectInfo& info : catalogue()) {
    const bool plain = info.parameters.size() == 1 && !info.one_run;
    if (plain && std::isfinite(info.parameters[0].plausible_min + info.parameters[0].plausible_max))
      choices.push_back(&info);
  }
  const int count = int(random.uniform(0, 3));
  for (int i = 0; i < count; ++i) {
    const EffectInfo& info = *choices[std::size_t(random.uniform(0, double(choices.size())))];
    const auto same = [&](const Effect& e) { return e.info == &info; };
    if (std::any_of(s.effects.begin(), s.effects.end(), same)) continue;
    Effect effect;
    effect.info = &info;
    effect.values.numbers = {random.uniform(info.parameters[0].plausible_min, info.parameters[0].plausible_max)};
    s.effects.push_back(effect);
  }
}

}  // namespace

std::vector<fs::path> drivable_robots(const fs::path& folder) {
  std::vector<fs::path> robots;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".urdf") continue;
    Scenario s;
    s.robot.urdf = fs::absolute(entry.path());
    give_size(s);
    try {
      load_scenario_robot(s);
      robots.push_back(fs::absolute(entry.path()));
    } catch (const InputError&) {
    }
  }
  std::sort(robots.begin(), robots.end());
  return robots;
}

Scenario draw_scenario(const std::vector<fs::path>& robots, std::uint64_t seed, int index) {
  RandomStream random(seed, "standing", std::uint64_t(index));
  Scenario s;
  s.name = "standing";
  s.seed = seed + std::uint64_t(index);
  s.robot.urdf = robots[std::size_t(random.uniform(0, double(robots.size())))];
  give_size(s);
  s.runs.per_direction = 1;
  s.calibration.method = Calibrate::none;
  s.truth.kind = "endpoints";
  s.course.side_m = random.uniform(0.5, 2);
  s.course.linear_speed_mps = random.uniform(0.05, 0.4);
  s.course.angular_speed_radps = random.uniform(0.2, 1.2);
  s.course.laps = 1;
  s.floor_friction = random.uniform(0.4, 1);
  const AccelerationLimits tips = understand_robot(s).tips;
  const double most = std::min({1.0, kReserve * tips.forward_mps2, kReserve * tips.backward_mps2});
  s.course.linear_acceleration_mps2 = random.uniform(0.3 * most, most);
  s.course.angular_acceleration_radps2 = std::min(random.uniform(0.3, 2), kReserve * tips.turning_radps2);
  if (index % 2 == 1) {
    s.noise.floor_rms_m = log_uniform(random, 1e-4, 2e-3);
    s.noise.floor_wavelength_m = random.uniform(0.15, 1);
  }
  draw_effects(s, random);
  return s;
}

}  // namespace umbsim
