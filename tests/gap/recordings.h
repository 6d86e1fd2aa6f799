#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "experiment/replay/replay.h"
#include "experiment/run.h"
#include "gap/replay/simulator.h"

namespace umbsim::testing {

inline Effect effect(const std::string& name, const std::vector<std::pair<std::string, double>>& values,
                     const std::string& run = "") {
  Effect e = neutral_effect(find_effect(name));
  for (const auto& [parameter, value] : values) {
    bool known = false;
    for (std::size_t i = 0; i < e.info->parameters.size(); ++i) {
      if (e.info->parameters[i].name != parameter) continue;
      e.values.numbers[i] = value;
      known = true;
    }
    EXPECT_TRUE(known) << name << " has no " << parameter;
  }
  e.values.run = run;
  return e;
}

/// A LabMate on squares of `side_m`, with a real encoder and a good tracker.
inline Scenario squares(double side_m, int per_direction) {
  Scenario s = read_scenario(std::string(UMBSIM_SOURCE_DIR) + "/scenarios/nominal.yaml");
  s.encoders.ticks_per_revolution = 2000;
  s.course.side_m = side_m;
  s.course.linear_speed_mps = 0.3;
  s.runs.per_direction = per_direction;
  return s;
}

/// Noise of a good robot in a good laboratory.
inline void add_noise(Scenario& s, std::uint64_t seed) {
  s.seed = seed;
  s.noise.wheel_noise_m_per_sqrt_m = 1e-4;
  s.noise.radius_scatter = 3e-5;
  s.truth.position_sd_m = 3e-4;
  s.truth.heading_sd_rad = 3e-4;
}

/// Plain, fast and loaded squares of one robot with hidden effects, as one recording.
inline Recording campaign(const std::vector<Effect>& hidden, std::uint64_t seed, double side_m = 2) {
  Scenario plain = squares(side_m, 2);
  add_noise(plain, seed);
  plain.effects = hidden;
  Recording all = run_experiment(plain, 0).recording;
  // What happens in one plain run happens in none of the others, which have their names when they are driven.
  plain.effects.erase(
      std::remove_if(plain.effects.begin(), plain.effects.end(), [](const Effect& e) { return !e.values.run.empty(); }),
      plain.effects.end());
  Scenario fast = plain;
  fast.seed = seed + 1000;
  fast.runs.per_direction = 1;
  fast.course.linear_speed_mps = 0.5;
  for (RecordedRun run : run_experiment(fast, 0).recording.runs) {
    run.id = run.direction + "-fast";
    run.linear_speed_mps = 0.5;
    all.runs.push_back(run);
  }
  Scenario loaded = plain;
  loaded.seed = seed + 2000;
  loaded.runs.per_direction = 1;
  constexpr double kPayload_kg = 15;
  const Eigen::Vector3d com = load_scenario_robot(plain).base.com_m;
  loaded.effects.push_back(effect(
      "load_shift", {{"payload_kg", kPayload_kg}, {"ahead_m", com.x()}, {"left_m", com.y()}, {"height_m", com.z()}}));
  for (RecordedRun run : run_experiment(loaded, 0).recording.runs) {
    run.id = run.direction + "-loaded";
    run.payload_kg = kPayload_kg;
    all.runs.push_back(run);
  }
  return all;
}

/// The same with squares whose start is turned by 90 degrees: every place is passed in two directions.
inline Recording turned_campaign(const std::vector<Effect>& hidden, std::uint64_t seed) {
  Recording all = campaign(hidden, seed);
  Scenario turned = squares(2, 1);
  add_noise(turned, seed + 3000);
  turned.effects = hidden;
  turned.runs.start_heading_rad = M_PI / 2;
  for (RecordedRun run : run_experiment(turned, 0).recording.runs) {
    run.id = run.direction + "-turned";
    all.runs.push_back(run);
  }
  return all;
}

inline gap::Simulator simulator(const Replay& replay) {
  return {[&replay](std::size_t run, const std::vector<Effect>& effects, double roughness_m_per_sqrt_m) {
            return replay.poses(run, effects, roughness_m_per_sqrt_m);
          },
          [&replay](std::size_t run, const std::vector<Effect>& effects) { return replay.counts(run, effects); },
          [&replay](const std::vector<Effect>& effects) { return replay.command_features(effects); },
          [&replay](const std::vector<Effect>& effects) { return replay.scrubs(effects); },
          replay.wheel_width_m(),
          replay.nominal().total_mass_kg()};
}

}  // namespace umbsim::testing
