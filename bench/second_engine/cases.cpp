#include "bench/second_engine/cases.h"

#include <set>

#include "core/yaml_reader.h"
#include "recording/names.h"

namespace umbsim::second_engine {
namespace {

EngineOptions read_engine(const YamlValue& value) {
  YamlMap map(value);
  EngineOptions o;
  o.step_s = map.number("step_s", o.step_s, {0, 0.02, true});
  o.integrator = map.choice("integrator", o.integrator, {"Euler", "implicit"});
  o.cone = map.choice("cone", o.cone, {"pyramidal", "elliptic"});
  o.wheel = map.choice("wheel", o.wheel, {"sphere", "ellipsoid", "cylinder"});
  o.impratio = map.number("impratio", o.impratio, {0, 1e6, true});
  o.impedance = map.number("impedance", o.impedance, Bounds::between(0.01, 0.9999));
  o.contact_time_s = map.number("contact_time_s", o.contact_time_s, {0, 1, true});
  o.contact_damping_ratio = map.number("contact_damping_ratio", o.contact_damping_ratio, {0, 100, true});
  o.servo_nms = map.number("servo_nms", o.servo_nms, {0, 1e6, true});
  o.armature_kgm2 = map.number("armature_kgm2", o.armature_kgm2, Bounds::between(0, 1e3));
  o.clock_offset_s = map.number("clock_offset_s", o.clock_offset_s, Bounds::between(0, 0.02));
  map.finish();
  return o;
}

TrialNoise read_noise(const YamlValue& value) {
  YamlMap map(value);
  TrialNoise n;
  n.heading_walk_rad_per_sqrt_m =
      map.number("heading_walk_rad_per_sqrt_m", n.heading_walk_rad_per_sqrt_m, {0, 0.1, true});
  n.radius_scatter = map.number("radius_scatter", n.radius_scatter, Bounds::between(0, 0.1));
  n.position_sd_m = map.number("position_sd_m", n.position_sd_m, {0, 1, true});
  n.heading_sd_rad = map.number("heading_sd_rad", n.heading_sd_rad, {0, 1, true});
  map.finish();
  return n;
}

TrialRobot read_robot(const YamlValue& value) {
  YamlMap map(value);
  TrialRobot r;
  r.wheel_radius_m = map.number("wheel_radius_m", {0.01, 1, true});
  r.wheelbase_m = map.number("wheelbase_m", {0.05, 5, true});
  r.base_mass_kg = map.number("base_mass_kg", {0.1, 1000, true});
  r.caster_ahead_m = map.number("caster_ahead_m", {0.01, 5, true});
  r.mass_centre_ahead_m = map.number("mass_centre_ahead_m", {0, r.caster_ahead_m, true});
  r.mass_centre_height_m = map.number("mass_centre_height_m", Bounds::between(-1, 2));
  map.finish();
  return r;
}

Platform read_platform(const YamlValue& value) {
  YamlMap map(value);
  Platform p;
  p.robot = read_robot(map.at("robot"));
  p.ticks_per_revolution = map.number("ticks_per_revolution", {1, 1e7, true});
  YamlMap path(map.at("path"));
  p.side_m = path.number("side_m", {1, 100, false});
  p.linear_speed_mps = path.number("linear_speed_mps", {0, 5, true});
  p.angular_speed_radps = path.number("angular_speed_radps", {0, 10, true});
  path.finish();
  map.finish();
  return p;
}

std::vector<std::string> read_excluded(const YamlValue& value) {
  std::vector<std::string> names, excluded;
  for (const EffectInfo& info : catalogue()) names.push_back(info.name);
  for (const YamlValue& item : value.list()) excluded.push_back(item.choice(names));
  return excluded;
}

// The engine has Coulomb contacts: nothing slips in proportion to its load's share.
void refuse_creep(const YamlValue& value, const std::vector<Effect>& effects) {
  for (const Effect& e : effects) {
    if (e.info->name == "tyre_creep") value.fail("MuJoCo's contacts have no tyre_creep");
  }
}

Case read_case(const YamlValue& value, const std::map<std::string, Platform>& platforms) {
  YamlMap map(value);
  Case c;
  c.name = map.at("name").string();
  if (const std::string problem = run_id_problem(c.name); !problem.empty()) map.at("name").fail(problem);
  std::vector<std::string> names;
  for (const auto& [name, platform] : platforms) names.push_back(name);
  c.platform = map.at("platform").choice(names);
  c.effects = read_effects(map.at("effects"));
  refuse_creep(map.at("effects"), c.effects);
  if (const auto list = map.find("excluded")) c.excluded = read_excluded(*list);
  map.finish();
  return c;
}

}  // namespace

CaseList read_cases(const std::string& file) {
  YamlMap map(YamlValue::load(file));
  CaseList list;
  list.file = file;
  map.at("format").choice({"umbsim-second-engine/1"});
  list.seed = std::uint64_t(map.integer("seed", 1, 0, std::numeric_limits<std::int64_t>::max()));
  if (const auto engine = map.find("engine")) list.engine = read_engine(*engine);
  if (const auto noise = map.find("noise")) list.noise = read_noise(*noise);
  for (const auto& [name, platform] : YamlMap(map.at("platforms")).entries()) {
    list.platforms[name] = read_platform(platform);
  }
  std::set<std::string> names;
  for (const YamlValue& item : map.at("cases").list()) {
    list.cases.push_back(read_case(item, list.platforms));
    if (!names.insert(list.cases.back().name).second) item.fail("the name is given twice");
  }
  map.finish();
  return list;
}

}  // namespace umbsim::second_engine
