#include "bench/worlds/draw/worlds_list_world.h"

#include "gap/trial/draw/platform.h"

namespace umbsim::worlds {
namespace {

const std::vector<std::string> kEngineNames = {"ours", "planar", "bullet", "mujoco"};
constexpr double kRollingShare = 0.15;  // of the side: radius of rolling turns that are not given

const EngineKind& read_engine(const YamlValue& value) {
  const std::string name = value.choice(kEngineNames);
  try {
    return find_engine(name);
  } catch (const InputError& e) {
    value.fail(e.what());
  }
}

EngineOptions read_options(const EngineKind& kind, const YamlValue& value) {
  YamlMap map(value);
  EngineOptions options = middle_options(kind);
  for (const EngineOption& o : kind.options) {
    if (o.draw == EngineOption::Draw::choice) {
      std::string& chosen = options.choices[o.name];
      chosen = map.choice(o.name, chosen, o.choices);
    } else {
      double& number = options.numbers[o.name];
      const auto allowed = kind.allowed.find(o.name);
      number =
          map.number(o.name, number, allowed != kind.allowed.end() ? allowed->second : Bounds::between(o.min, o.max));
    }
  }
  map.finish();
  return options;
}

Physics read_physics(const YamlValue& value) {
  YamlMap map(value);
  Physics p;
  p.friction = map.number("friction", p.friction, {0, 2, true});
  p.creep_along = map.number("creep_along", p.creep_along, Bounds::between(0, 0.1));
  p.creep_across = map.number("creep_across", p.creep_across, Bounds::between(0, 0.1));
  p.patch_width_m = map.number("patch_width_m", p.patch_width_m, Bounds::between(0, kTrialWheelWidth_m));
  p.motor_lag_s = map.number("motor_lag_s", p.motor_lag_s, Bounds::between(0, 1));
  p.caster_friction = map.number("caster_friction", p.caster_friction, Bounds::between(0, 1));
  map.finish();
  return p;
}

DriverChoice read_driver(const YamlValue& value) {
  YamlMap map(value);
  DriverChoice d;
  d.kind = map.choice("kind", d.kind, names_in(kDriverKinds));
  d.rate_hz = map.number("rate_hz", d.rate_hz, Bounds::between(5, 200));
  d.open_loop = map.boolean("open_loop", d.open_loop);
  d.jumps = map.choice("set_points", "ramp", {"ramp", "jump"}) == "jump";
  d.heading_gain_1ps = map.number("heading_gain_1ps", d.heading_gain_1ps, {0, 10, true});
  d.across_gain_radpms = map.number("across_gain_radpms", d.across_gain_radpms, Bounds::between(0, 10));
  d.look_ahead_m = map.number("look_ahead_m", d.look_ahead_m, {0, 5, true});
  d.dead_time_s = map.number("dead_time_s", d.dead_time_s, Bounds::between(0, 1));
  d.tremor_radps = map.number("tremor_radps", d.tremor_radps, Bounds::between(0, 1));
  map.finish();
  return d;
}

TrackerChoice read_tracker(const YamlValue& value) {
  YamlMap map(value);
  TrackerChoice t = exact_tracker(map.choice("kind", "mocap", names_in(kTrackerKinds)));
  t.rate_hz = map.number("rate_hz", t.rate_hz, Bounds::between(1, 1000));
  t.position_sd_m = map.number("position_sd_m", t.position_sd_m, {0, 1, true});
  if (t.sees_heading) t.heading_sd_rad = map.number("heading_sd_rad", t.heading_sd_rad, {0, 1, true});
  t.delay_s = map.number("delay_s", t.delay_s, Bounds::between(0, 1));
  t.clock_drift = map.number("clock_drift", t.clock_drift, Bounds::between(-0.01, 0.01));
  t.dropout = map.number("dropout", t.dropout, Bounds::between(0, 0.9));
  map.finish();
  return t;
}

Noise read_noise(const YamlValue& value) {
  YamlMap map(value);
  Noise n = usual_noise(1);
  n.heading_walk_rad_per_sqrt_m =
      map.number("heading_walk_rad_per_sqrt_m", n.heading_walk_rad_per_sqrt_m, Bounds::between(0, 0.1));
  n.radius_scatter = map.number("radius_scatter", n.radius_scatter, Bounds::between(0, 0.1));
  n.motor_scatter = map.number("motor_scatter", n.motor_scatter, Bounds::between(0, 0.1));
  map.finish();
  return n;
}

WorldRobot read_robot(const std::string& name, const YamlValue& value, double ticks_per_revolution) {
  YamlMap map(value);
  TrialRobot r;
  r.wheel_radius_m = map.number("wheel_radius_m", {0.01, 1, true});
  r.wheelbase_m = map.number("wheelbase_m", {0.05, 5, true});
  r.base_mass_kg = map.number("base_mass_kg", {0.1, 1000, true});
  r.caster_ahead_m = map.number("caster_ahead_m", {0.01, 5, true});
  r.mass_centre_ahead_m = map.number("mass_centre_ahead_m", {0, r.caster_ahead_m, true});
  r.mass_centre_height_m = map.number("mass_centre_height_m", Bounds::between(-1, 2));
  map.finish();
  return make_robot(name, umbsim::robot_urdf(r), ticks_per_revolution);
}

PlannedRuns read_path(const YamlValue& value, const std::string& set, const WorldRobot& robot, double rate_hz) {
  YamlMap map(value);
  Course c;
  c.side_m = map.number("side_m", Bounds::between(1, 100));
  c.linear_speed_mps = map.number("linear_speed_mps", {0, 5, true});
  c.angular_speed_radps = map.number("angular_speed_radps", {0, 10, true});
  c.linear_acceleration_mps2 = map.number("linear_acceleration_mps2", c.linear_acceleration_mps2, {0, 10, true});
  c.angular_acceleration_radps2 =
      map.number("angular_acceleration_radps2", c.angular_acceleration_radps2, {0, 50, true});
  const double rolling_m = map.number("turn_radius_m", kRollingShare * c.side_m, {0, 0.45 * c.side_m, true});
  map.finish();
  return plan_squares(set, robot, c, rolling_m, rate_hz);
}

World read_platform(const std::string& name, const YamlValue& value, const std::string& runs, World w) {
  YamlMap map(value);
  w.robot = read_robot(name, map.at("robot"), map.number("ticks_per_revolution", {1, 1e7, true}));
  w.runs = read_path(map.at("path"), runs, w.robot, w.driver.rate_hz);
  map.finish();
  Recording& r = w.runs.recording;
  r.truth_kind = w.tracker.end_points ? "endpoints" : "track";
  r.truth_position_sd_m = w.tracker.position_sd_m;
  r.truth_heading_sd_rad = w.tracker.heading_sd_rad;
  return w;
}

}  // namespace

std::map<std::string, World> read_listed_worlds(YamlMap& map) {
  World common;
  common.engine = &read_engine(map.at("engine"));
  common.options = middle_options(*common.engine);
  common.tracker = exact_tracker("mocap");
  if (const auto value = map.find("options")) common.options = read_options(*common.engine, *value);
  if (const auto value = map.find("physics")) common.physics = read_physics(*value);
  if (const auto value = map.find("driver")) common.driver = read_driver(*value);
  if (const auto value = map.find("tracker")) common.tracker = read_tracker(*value);
  if (const auto value = map.find("noise")) common.noise = read_noise(*value);
  const std::string runs = map.choice("runs", "recommended", names_in(kSquareSets));
  std::map<std::string, World> worlds;
  for (const auto& [name, value] : YamlMap(map.at("platforms")).entries())
    worlds[name] = read_platform(name, value, runs, common);
  if (worlds.empty()) map.at("platforms").fail("must name at least one");
  return worlds;
}

}  // namespace umbsim::worlds
