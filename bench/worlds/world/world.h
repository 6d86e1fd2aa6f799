#pragma once

#include <cstdint>
#include <iterator>
#include <string>
#include <vector>

#include "bench/worlds/drivers/driver.h"
#include "bench/worlds/engines/engine.h"
#include "bench/worlds/world/outside.h"
#include "bench/worlds/world/robot.h"
#include "bench/worlds/world/run_set.h"
#include "bench/worlds/world/tracker.h"

namespace umbsim::worlds {

/// An array of names as a file's reader takes it.
template <std::size_t N>
std::vector<std::string> names_in(const char* const (&names)[N]) {
  return {std::begin(names), std::end(names)};
}

/// What tyres, motors and casters are like in a world before anything is wrong with them.
struct Physics {
  double friction = 0.9;
  double creep_along = 0;
  double creep_across = 0;
  double patch_width_m = 0;
  double motor_lag_s = 0;
  double caster_friction = 0;
};

/// Random errors of a run, as in a trial (gap/trial/draw/trial_plan.h), at this level.
struct Noise {
  double heading_walk_rad_per_sqrt_m = 0;
  double radius_scatter = 0;
  double motor_scatter = 0;
};
Noise usual_noise(double level);

/// What is wrong with a robot.
struct Faults {
  std::vector<Effect> effects;
  std::vector<OutsideEffect> outside;
};

/// A robot in a simulator, its driver, its tracker and its runs: a world, whatever may be wrong in it.
struct World {
  const EngineKind* engine = nullptr;
  EngineOptions options;
  WorldRobot robot;
  Physics physics;
  DriverChoice driver;
  TrackerChoice tracker;
  PlannedRuns runs;
  double noise_level = 1;  ///< of the trial's
  Noise noise = usual_noise(1);
};

/// What to draw worlds from.
struct WorldChoices {
  std::vector<std::string> drivers;
  std::vector<std::string> trackers;
  std::vector<std::string> runs;
  std::string robots_folder;
};

/// Draws everything but what is wrong.
World draw_world(const EngineKind& engine, const WorldChoices& choices, RandomStream& random);

}  // namespace umbsim::worlds
