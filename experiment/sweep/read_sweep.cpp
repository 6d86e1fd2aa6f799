#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "batch/store/store.h"
#include "experiment/output/figures.h"
#include "experiment/scenario/settings.h"
#include "experiment/sweep/sweep.h"

namespace umbsim {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kMaxPoints = 100000000;
constexpr std::int64_t kMaxSamples = 10000000;
constexpr std::int64_t kMaxReplicates = 1000000;

bool is_sampling(Design design) { return design == Design::latin_hypercube || design == Design::sobol; }

// The scenario's file as YAML, with the sweep's `set` and the command line's --set.
YamlValue read_base(Sweep& sweep, YamlMap& map, const std::vector<std::string>& settings) {
  const YamlValue file = map.at("scenario");
  const fs::path given = file.string();
  sweep.scenario_file =
      (given.is_absolute() ? given : fs::path(sweep.file).parent_path() / given).lexically_normal().string();
  if (!fs::is_regular_file(sweep.scenario_file))
    file.fail(fmt::format("'{}': there is no such file", sweep.scenario_file));
  const auto set = map.find("set");
  const auto document = [&](std::size_t count) {
    const YamlValue base = YamlValue::load(sweep.scenario_file);
    if (set) {
      for (const auto& [key, value] : YamlMap(*set).entries())
        apply_setting(base, key + "=" + read_axis_value(value).yaml);
    }
    for (std::size_t i = 0; i < count; ++i) apply_setting(base, settings[i]);
    return base;
  };
  try {
    if (set) read_scenario(document(0));
  } catch (const InputError& e) {
    set->fail(e.what());
  }
  const YamlValue base = document(settings.size());
  try {
    read_scenario(base);
  } catch (const InputError& e) {
    blame_setting(e, settings, document);
  }
  return base;
}

// `key=values` of the command line.
Axis read_axis_setting(const std::string& text, bool may_sample) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) {
    throw InputError("--axis " + text + ": must have the form key.path=values, as in course.side_m=[2, 4]");
  }
  return read_axis(text.substr(0, equals), YamlValue::parse(text.substr(equals + 1), "--axis " + text), may_sample);
}

void read_axes(Sweep& sweep, YamlMap& map, const std::vector<std::string>& settings) {
  if (sweep.design == Design::list) {
    if (map.has("axes")) map.at("axes").fail("has no meaning with design: list; give the points under `points`");
    if (!settings.empty()) throw InputError("--axis " + settings.front() + ": has no meaning with design: list");
    return;
  }
  const bool sampling = is_sampling(sweep.design);
  const auto axes = map.find("axes");
  if (axes) {
    for (const auto& [key, value] : YamlMap(*axes).entries()) sweep.axes.push_back(read_axis(key, value, sampling));
  }
  for (const std::string& setting : settings) {
    const Axis axis = read_axis_setting(setting, sampling);
    const auto same =
        std::find_if(sweep.axes.begin(), sweep.axes.end(), [&](const Axis& a) { return a.key == axis.key; });
    if (same == sweep.axes.end()) sweep.axes.push_back(axis);
    else *same = axis;
  }
  if (sweep.axes.empty()) map.at("axes").fail("must name at least one axis");
  const bool any_range = std::any_of(sweep.axes.begin(), sweep.axes.end(), [](const Axis& a) { return a.sampled(); });
  if (sampling && !any_range) map.at("axes").fail("must have at least one range {from, to} that the design can sample");
}

// design: list. Every point names the same keys.
void read_listed_points(Sweep& sweep, const YamlValue& value) {
  for (const YamlValue& item : value.list()) {
    YamlMap map(item);
    if (sweep.axes.empty()) {
      for (const auto& [key, v] : map.entries()) sweep.axes.push_back(Axis{key, v.mark(), {}});
    }
    for (Axis& axis : sweep.axes) axis.values.push_back(read_axis_value(map.at(axis.key)));
    map.finish();
  }
  if (sweep.axes.empty()) value.fail("must have at least one point with at least one key");
}

void read_design(Sweep& sweep, YamlMap& map, const std::vector<std::string>& axes) {
  const std::string design = map.choice("design", "grid", {"grid", "list", "latin_hypercube", "sobol"});
  for (const Design d : {Design::grid, Design::list, Design::latin_hypercube, Design::sobol}) {
    if (design == name(d)) sweep.design = d;
  }
  read_axes(sweep, map, axes);
  if (sweep.design == Design::list) read_listed_points(sweep, map.at("points"));
  sweep.replicates = map.integer("replicates", 1, 1, kMaxReplicates);
  sweep.own_seeds = map.choice("seeds", "same", {"same", "own"}) == "own";
  if (!is_sampling(sweep.design)) return;
  sweep.samples = map.at("samples").integer(1, kMaxSamples);
  sweep.sample_seed = std::uint64_t(map.integer("sample_seed", 1, 0, std::numeric_limits<std::int64_t>::max()));
  const auto dimensions = std::size_t(
      std::count_if(sweep.axes.begin(), sweep.axes.end(), [](const Axis& a) { return a.sampled(); }));
  sweep.shares = sweep.design == Design::sobol ? sobol(sweep.samples, dimensions)
                                               : latin_hypercube(sweep.samples, dimensions, sweep.sample_seed);
}

void count_points(Sweep& sweep, const YamlValue& document) {
  double points = double(sweep.replicates);
  if (sweep.design == Design::list) points *= double(sweep.axes.front().values.size());
  if (is_sampling(sweep.design)) points *= double(sweep.samples);
  if (sweep.design != Design::list) {
    for (const Axis& axis : sweep.axes) points *= axis.sampled() ? 1 : double(axis.values.size());
  }
  if (points > double(kMaxPoints))
    document.fail(fmt::format("{} points are too many (must be <= {})", points, kMaxPoints));
  sweep.points = std::int64_t(points);
}

// An axis may not have the name of another column of the store, nor vary what a replicate varies.
void check_keys(const Sweep& sweep) {
  std::set<std::string> taken(Store::fixed_columns().begin(), Store::fixed_columns().end());
  taken.insert(figure_names().begin(), figure_names().end());
  for (const Axis& axis : sweep.axes) {
    if (!taken.insert(axis.key).second || axis.key == "expect" || axis.key == "format") {
      throw InputError(axis.mark, fmt::format("'{}' cannot be an axis", axis.key));
    }
    if (axis.key == "seed" && (sweep.replicates > 1 || sweep.own_seeds)) {
      throw InputError(axis.mark,
                       "an axis over the seed leaves nothing to `replicates` and `seeds: own`, which vary it");
    }
  }
}

std::string definition_of(const Sweep& sweep, Scenario base) {
  base.name = base.description = "";
  base.expect.clear();
  nlohmann::ordered_json axes = nlohmann::ordered_json::array();
  for (const Axis& axis : sweep.axes) {
    nlohmann::ordered_json values = nlohmann::ordered_json::array();
    for (const AxisValue& value : axis.values) values.push_back(value.yaml);
    nlohmann::ordered_json json{{"key", axis.key}};
    if (!axis.sampled()) json["values"] = values;
    else json.update({{"from", axis.from}, {"to", axis.to}, {"log", axis.logarithmic}, {"integer", axis.integer}});
    axes.push_back(json);
  }
  const nlohmann::ordered_json json{
      {"format", "umbsim-sweep/1"},    {"scenario", resolved_yaml(base)},     {"design", name(sweep.design)},
      {"axes", axes},                  {"samples", sweep.samples},            {"sample_seed", sweep.sample_seed},
      {"replicates", sweep.replicates}, {"seeds", sweep.own_seeds ? "own" : "same"}};
  return json.dump(1);
}

SweepView read_view(const Sweep& sweep, const YamlValue& value) {
  YamlMap map(value);
  std::vector<std::string> keys;
  for (const Axis& axis : sweep.axes) keys.push_back(axis.key);
  SweepView view;
  if (map.has("x")) view.x = map.choice("x", "", keys);
  if (map.has("y")) view.y = map.choice("y", "", keys);
  if (map.has("figure")) view.figure = map.choice("figure", "", figure_names());
  view.logarithmic = map.choice("scale", "linear", {"linear", "log"}) == "log";
  map.finish();
  return view;
}

void check_conditions(const Sweep& sweep, const YamlValue& expect) {
  std::vector<std::string> known = figure_names();
  for (const Axis& axis : sweep.axes) known.push_back(axis.key);
  known.push_back("replicate");
  for (const Expectation& e : sweep.expect) {
    for (const Condition& c : e.where) {
      if (std::find(known.begin(), known.end(), c.key) != known.end()) continue;
      expect.fail(fmt::format("{}: where: '{}' is neither an axis nor a figure; {}", e.figure, c.key,
                              list_choices(c.key, known)));
    }
  }
}

}  // namespace

Sweep read_sweep(const std::string& file, const std::vector<std::string>& settings,
                 const std::vector<std::string>& axes) {
  const YamlValue document = YamlValue::load(file);
  YamlMap map(document);
  Sweep sweep;
  sweep.file = file;
  map.choice("format", "umbsim-sweep/1", {"umbsim-sweep/1"});
  sweep.name = map.string("name", fs::path(file).stem().string());
  if (sweep.name.empty() || sweep.name.find_first_of("/\\") != std::string::npos || sweep.name.front() == '.') {
    map.at("name").fail("must be usable as a folder name: not empty, without slashes, not starting with a dot");
  }
  sweep.description = map.string("description", "");
  const YamlValue base = read_base(sweep, map, settings);
  const Scenario scenario = read_scenario(base);
  sweep.scenario.reset(base.node());
  read_design(sweep, map, axes);
  if (const auto v = map.find("expect")) sweep.expect = read_expectations(*v, ExpectationsOf::sweep);
  if (const auto v = map.find("report")) sweep.view = read_view(sweep, *v);
  map.finish();
  if (const auto v = map.find("expect")) check_conditions(sweep, *v);
  count_points(sweep, document);
  check_keys(sweep);
  sweep.definition = definition_of(sweep, scenario);
  return sweep;
}

}  // namespace umbsim
