#include "bench/worlds/world/world.h"

#include <algorithm>
#include <cmath>

namespace umbsim::worlds {
namespace {

constexpr double kNeutral = 0.5;  // share of worlds without the one or other imperfection

const std::string& pick(const std::vector<std::string>& names, RandomStream& random) {
  return names[std::min(names.size() - 1, std::size_t(random.uniform() * double(names.size())))];
}

double now_and_then(RandomStream& random, double max) {
  const double u = random.uniform(), value = random.uniform(0, max);
  return u < kNeutral ? 0 : value;
}

// What is usual, and nobody would call a fault.
Physics draw_physics(const RobotModel& robot, RandomStream& random) {
  Physics p;
  p.friction = random.uniform(0.4, 1.2);
  p.creep_along = now_and_then(random, 0.003);
  p.creep_across = now_and_then(random, 0.003);
  p.patch_width_m = now_and_then(random, 0.1 * robot.wheels[0].width_m);
  p.motor_lag_s = now_and_then(random, 0.03);
  p.caster_friction = now_and_then(random, 0.01);
  return p;
}

}  // namespace

Noise usual_noise(double level) {
  const TrialNoise n;
  return {n.heading_walk_rad_per_sqrt_m * level, n.radius_scatter * level, n.motor_scatter * level};
}

World draw_world(const EngineKind& engine, const WorldChoices& choices, RandomStream& random) {
  World w;
  w.engine = &engine;
  w.options = draw_options(engine, random);
  w.robot = draw_robot(choices.robots_folder, random);
  w.physics = draw_physics(w.robot.model, random);
  w.driver = draw_driver(pick(choices.drivers, random), random);
  w.tracker = draw_tracker(pick(choices.trackers, random), random);
  w.runs = plan_runs(pick(choices.runs, random), w.robot, w.driver.rate_hz, random);
  w.noise_level = random.uniform(0.7, 1.4);
  w.noise = usual_noise(w.noise_level);
  Recording& r = w.runs.recording;
  r.truth_kind = w.tracker.end_points ? "endpoints" : "track";
  r.truth_position_sd_m = w.tracker.position_sd_m;
  r.truth_heading_sd_rad = w.tracker.heading_sd_rad;
  return w;
}

}  // namespace umbsim::worlds
