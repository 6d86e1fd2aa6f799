#include "bench/worlds/draw/worlds_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <set>

#include "bench/worlds/draw/worlds_list_world.h"
#include "core/sha256.h"
#include "core/text/text_file.h"
#include "core/text/yaml_reader.h"
#include "recording/names.h"

namespace umbsim::worlds {
namespace {

constexpr std::size_t kMaxListBytes = 16 * 1024 * 1024;
constexpr double kStrongest = 10;  // of an effect outside the catalogue, over the strongest that is drawn

// An effect that the engine cannot express, or of a run that is not driven, would leave a robot without it.
void check_effects(const World& w, const YamlValue& value, const std::vector<Effect>& effects) {
  YamlMap map(value);
  std::vector<std::string> runs;
  for (const RecordedRun& r : w.runs.recording.runs) runs.push_back(r.id);
  for (const Effect& e : effects) {
    const YamlValue of_effect = map.at(e.info->name);
    if (w.engine->expresses.count(e.info->name) == 0) {
      of_effect.fail(fmt::format("the engine {} cannot express {}; `umbsim_worlds table` says what it can",
                                 w.engine->name, e.info->name));
    }
    if (e.info->one_run) YamlMap(of_effect).at("run").choice(runs);
  }
}

OutsideEffect read_outside(const OutsideInfo& info, const YamlValue& value) {
  YamlMap map(value);
  OutsideEffect e{&info, {}};
  e.values[info.parameter] = map.number(info.parameter, {0, kStrongest * info.plausible.max, true});
  e.values["wheel"] = double(map.integer("wheel", 0, 0, 1));
  e.values["sign"] = double(map.integer("sign", 1, -1, 1));
  if (e.values["sign"] == 0) map.at("sign").fail("must be -1 or 1");
  e.values["direction_rad"] = map.number("direction_rad", 0, Bounds::between(-7, 7));
  e.values["phase_rad"] = map.number("phase_rad", 0, Bounds::between(-7, 7));
  e.values["hertz"] = map.number("hertz", 1, {0, 20, true});
  if (info.place) {
    e.values["x_m"] = map.number("x_m", {});
    e.values["y_m"] = map.number("y_m", {});
    e.values["radius_m"] = map.number("radius_m", {0, 100, true});
  }
  map.finish();
  return e;
}

std::vector<OutsideEffect> read_outside_effects(const YamlValue& value) {
  YamlMap map(value);
  std::vector<OutsideEffect> effects;
  for (const OutsideInfo& info : outside_effects()) {
    if (const auto found = map.find(info.name)) effects.push_back(read_outside(info, *found));
  }
  map.finish();
  return effects;
}

std::vector<std::string> read_excluded(const YamlValue& value) {
  std::vector<std::string> names, excluded;
  for (const EffectInfo& info : catalogue()) names.push_back(info.name);
  for (const YamlValue& item : value.list()) excluded.push_back(item.choice(names));
  return excluded;
}

ListedCase read_case(const YamlValue& value, const WorldsList& list) {
  YamlMap map(value);
  ListedCase c;
  c.given_name = map.at("name").string();
  if (const std::string problem = run_id_problem(c.given_name); !problem.empty()) map.at("name").fail(problem);
  c.name =
      fmt::format("{:012x}", RandomStream(list.seed, "worlds listed name " + c.given_name).bits() & 0xffffffffffff);
  std::vector<std::string> platforms;
  for (const auto& [name, world] : list.worlds) platforms.push_back(name);
  c.platform = map.at("platform").choice(platforms);
  if (const auto effects = map.find("effects")) {
    c.faults.effects = read_effects(*effects);
    check_effects(list.worlds.at(c.platform), *effects, c.faults.effects);
  }
  if (const auto outside = map.find("outside")) c.faults.outside = read_outside_effects(*outside);
  if (const auto excluded = map.find("excluded")) c.excluded = read_excluded(*excluded);
  map.finish();
  return c;
}

}  // namespace

WorldsList read_worlds_list(const std::string& file) {
  const std::string text = read_text_file(file, kMaxListBytes);
  YamlMap map(YamlValue::parse(text, file));
  WorldsList list;
  list.sha256 = sha256(text);
  map.at("format").choice({"umbsim-worlds-list/1"});
  list.name = map.string("name", std::filesystem::path(file).stem().string());
  if (const std::string problem = run_id_problem(list.name); !problem.empty()) map.at("name").fail(problem);
  list.description = map.string("description", "");
  list.seed = std::uint64_t(map.integer("seed", 1, 0, std::numeric_limits<std::int64_t>::max()));
  list.worlds = read_listed_worlds(map);
  std::set<std::string> names;
  for (const YamlValue& item : map.at("cases").list()) {
    list.cases.push_back(read_case(item, list));
    if (!names.insert(list.cases.back().given_name).second)
      YamlMap(item).at("name").fail(fmt::format("'{}' is given twice", list.cases.back().given_name));
  }
  if (list.cases.empty()) map.at("cases").fail("must list at least one");
  map.finish();
  std::sort(list.cases.begin(), list.cases.end(),
            [](const ListedCase& a, const ListedCase& b) { return a.name < b.name; });
  return list;
}

}  // namespace umbsim::worlds
