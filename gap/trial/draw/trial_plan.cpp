#include "gap/trial/draw/trial_plan.h"

#include <fmt/format.h>

#include <filesystem>
#include <set>

#include "core/text/yaml_reader.h"
#include "core/text/yaml_text.h"
#include "recording/names.h"

namespace umbsim {
namespace {

constexpr int kMaxCases = 100000;
constexpr int kMaxPlatforms = 1000;

Range read_range(const YamlValue& value, Bounds bounds) {
  const std::vector<YamlValue> ends = value.list();
  if (ends.size() != 2) value.fail("must be a range [from, to]");
  const Range range{ends[0].number(bounds), ends[1].number(bounds)};
  if (range.max < range.min) value.fail(fmt::format("from = {} is above to = {}", range.min, range.max));
  return range;
}

Range range(YamlMap& map, const char* key, Range fallback, Bounds bounds = Bounds::positive()) {
  const auto value = map.find(key);
  return value ? read_range(*value, bounds) : fallback;
}

TierSizes read_cases(const YamlValue& value) {
  YamlMap map(value);
  const auto count = [&](const char* key) { return int(map.integer(key, 0, 0, kMaxCases)); };
  TierSizes sizes;
  sizes.no_effect = count("no_effect");
  sizes.single = count("single");
  sizes.pairs = count("pairs");
  sizes.outside = count("outside");
  sizes.end_points = count("end_points");
  sizes.poor_runs = count("poor_runs");
  map.finish();
  return sizes;
}

std::vector<const EffectInfo*> whole_catalogue() {
  std::vector<const EffectInfo*> all;
  for (const EffectInfo& info : catalogue()) all.push_back(&info);
  return all;
}

std::vector<const EffectInfo*> read_effect_names(const YamlValue& value) {
  std::vector<std::string> names;
  for (const EffectInfo& info : catalogue()) names.push_back(info.name);
  std::vector<const EffectInfo*> effects;
  std::set<std::string> seen;
  for (const YamlValue& item : value.list()) {
    const std::string name = item.choice(names);
    if (!seen.insert(name).second) item.fail("the effect is given twice");
    effects.push_back(&find_effect(name));
  }
  if (effects.empty()) value.fail("must name at least one effect");
  return effects;
}

PlatformRanges read_platforms(const YamlValue& value) {
  YamlMap map(value);
  PlatformRanges p;
  p.count = int(map.integer("count", p.count, 1, kMaxPlatforms));
  p.wheel_radius_m = range(map, "wheel_radius_m", p.wheel_radius_m);
  p.wheelbase_m = range(map, "wheelbase_m", p.wheelbase_m);
  p.base_mass_kg = range(map, "base_mass_kg", p.base_mass_kg);
  p.caster_ahead_m = range(map, "caster_ahead_m", p.caster_ahead_m);
  p.mass_centre_share = range(map, "mass_centre_share", p.mass_centre_share, Bounds::between(0.05, 0.95));
  p.mass_centre_height_m = range(map, "mass_centre_height_m", p.mass_centre_height_m);
  p.ticks_per_revolution = range(map, "ticks_per_revolution", p.ticks_per_revolution, {1, 1e7, true});
  p.side_m = range(map, "side_m", p.side_m, Bounds::between(1, 100));
  p.linear_speed_mps = range(map, "linear_speed_mps", p.linear_speed_mps, {0, 5, true});
  p.angular_speed_radps = range(map, "angular_speed_radps", p.angular_speed_radps, {0, 10, true});
  map.finish();
  return p;
}

TrialNoise read_noise(const YamlValue& value) {
  YamlMap map(value);
  TrialNoise n;
  // Positive: without noise there is no floor in whose unit a severity could be drawn.
  n.heading_walk_rad_per_sqrt_m =
      map.number("heading_walk_rad_per_sqrt_m", n.heading_walk_rad_per_sqrt_m, {0, 0.1, true});
  n.radius_scatter = map.number("radius_scatter", n.radius_scatter, Bounds::between(0, 0.1));
  n.motor_scatter = map.number("motor_scatter", n.motor_scatter, Bounds::between(0, 0.1));
  n.position_sd_m = map.number("position_sd_m", n.position_sd_m, {0, 1, true});
  n.heading_sd_rad = map.number("heading_sd_rad", n.heading_sd_rad, {0, 1, true});
  n.level = range(map, "level", n.level);
  map.finish();
  return n;
}

PlannedRun read_run(const YamlValue& value) {
  YamlMap map(value);
  PlannedRun run;
  run.id = map.at("id").string();
  if (const std::string problem = run_id_problem(run.id); !problem.empty()) map.at("id").fail(problem);
  run.direction = map.at("direction").choice({"cw", "ccw"});
  run.start_heading_rad = map.number("start_heading_rad", 0, Bounds::between(-6.3, 6.3));
  run.speed_factor = map.number("speed_factor", 1, {0, 10, true});
  run.turn_radius_m = map.number("turn_radius_m", 0, Bounds::between(0, 0.45));
  run.payload_kg = map.number("payload_kg", 0, Bounds::between(0, 1000));
  map.finish();
  return run;
}

std::vector<PlannedRun> read_runs(const YamlValue& value) {
  std::vector<PlannedRun> runs;
  std::set<std::string> ids;
  bool plain = false;
  for (const YamlValue& item : value.list()) {
    runs.push_back(read_run(item));
    if (!ids.insert(runs.back().id).second) item.fail("run id '" + runs.back().id + "' is given twice");
    plain = plain || runs.back().plain();
  }
  if (!plain) value.fail("must have at least one plain run");
  return runs;
}

std::string text_of(const Range& r) {
  return fmt::format("[{}, {}]", yaml_number(r.min, "from"), yaml_number(r.max, "to"));
}

std::string text_of(const PlannedRun& run) {
  std::string text = fmt::format("  - {{id: {}, direction: {}", yaml_string(run.id), run.direction);
  const auto add = [&](const char* key, double value, double fallback) {
    if (value != fallback) text += fmt::format(", {}: {}", key, yaml_number(value, key));
  };
  add("start_heading_rad", run.start_heading_rad, 0);
  add("speed_factor", run.speed_factor, 1);
  add("turn_radius_m", run.turn_radius_m, 0);
  add("payload_kg", run.payload_kg, 0);
  return text + "}\n";
}

}  // namespace

std::vector<PlannedRun> recommended_runs() {
  std::vector<PlannedRun> runs;
  for (const char* number : {"1", "2"}) {
    for (const char* direction : {"cw", "ccw"}) runs.push_back({std::string(direction) + "-" + number, direction});
  }
  for (const char* direction : {"cw", "ccw"}) {
    const std::string d = direction;
    runs.push_back({d + "-rotated", d, 1.5708});
    runs.push_back({d + "-fast", d, 0, 2});
    runs.push_back({d + "-loaded", d, 0, 1, 0, 15});
    runs.push_back({d + "-rolling", d, 0, 1, 0.4});
  }
  return runs;
}

TrialPlan read_trial(const std::string& file) {
  const YamlValue document = YamlValue::load(file);
  YamlMap map(document);
  TrialPlan plan;
  plan.file = file;
  map.at("format").choice({"umbsim-trial/1"});
  plan.name = map.string("name", std::filesystem::path(file).stem().string());
  if (const std::string problem = run_id_problem(plan.name); !problem.empty()) map.at("name").fail(problem);
  plan.description = map.string("description", "");
  plan.seed = std::uint64_t(map.integer("seed", 1, 0, std::numeric_limits<std::int64_t>::max()));
  plan.cases = read_cases(map.at("cases"));
  const auto effects = map.find("effects");
  plan.effects = effects ? read_effect_names(*effects) : whole_catalogue();
  plan.severity = range(map, "severity", plan.severity);
  plan.decoy_exclusions = map.number("decoy_exclusions", plan.decoy_exclusions, Bounds::between(0, 1));
  if (const auto v = map.find("platforms")) plan.platforms = read_platforms(*v);
  if (const auto v = map.find("noise")) plan.noise = read_noise(*v);
  if (const auto v = map.find("runs")) plan.runs = read_runs(*v);
  map.finish();
  if (plan.cases.pairs > 0 && plan.effects.size() < 2) document.fail("cases.pairs needs at least two effects");
  return plan;
}

std::string resolved_trial(const TrialPlan& p) {
  const PlatformRanges& q = p.platforms;
  const TrialNoise& n = p.noise;
  std::string text = fmt::format(
      "format: umbsim-trial/1\nname: {}\ndescription: {}\nseed: {}\n"
      "cases: {{no_effect: {}, single: {}, pairs: {}, outside: {}, end_points: {}, poor_runs: {}}}\n",
      yaml_string(p.name), yaml_string(p.description), p.seed, p.cases.no_effect, p.cases.single, p.cases.pairs,
      p.cases.outside, p.cases.end_points, p.cases.poor_runs);
  text += "effects:\n";
  for (const EffectInfo* info : p.effects) text += "  - " + info->name + "\n";
  text += fmt::format("severity: {}\ndecoy_exclusions: {}\nplatforms:\n  count: {}\n", text_of(p.severity),
                      yaml_number(p.decoy_exclusions, "decoy_exclusions"), q.count);
  const auto add = [&](const char* key, const Range& range) { text += fmt::format("  {}: {}\n", key, text_of(range)); };
  add("wheel_radius_m", q.wheel_radius_m);
  add("wheelbase_m", q.wheelbase_m);
  add("base_mass_kg", q.base_mass_kg);
  add("caster_ahead_m", q.caster_ahead_m);
  add("mass_centre_share", q.mass_centre_share);
  add("mass_centre_height_m", q.mass_centre_height_m);
  add("ticks_per_revolution", q.ticks_per_revolution);
  add("side_m", q.side_m);
  add("linear_speed_mps", q.linear_speed_mps);
  add("angular_speed_radps", q.angular_speed_radps);
  text += fmt::format(
      "noise:\n  heading_walk_rad_per_sqrt_m: {}\n  radius_scatter: {}\n  motor_scatter: {}\n"
      "  position_sd_m: {}\n  heading_sd_rad: {}\n",
      yaml_number(n.heading_walk_rad_per_sqrt_m, ""), yaml_number(n.radius_scatter, ""),
      yaml_number(n.motor_scatter, ""), yaml_number(n.position_sd_m, ""), yaml_number(n.heading_sd_rad, ""));
  add("level", n.level);
  text += "runs:\n";
  for (const PlannedRun& run : p.runs) text += text_of(run);
  return text;
}

}  // namespace umbsim
