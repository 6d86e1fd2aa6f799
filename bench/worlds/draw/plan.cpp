#include "bench/worlds/draw/plan.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/text/yaml_reader.h"
#include "core/text/yaml_text.h"
#include "recording/names.h"

namespace umbsim::worlds {
namespace {

std::vector<std::string> engine_names() {
  std::vector<std::string> names;
  for (const EngineKind& kind : engines()) names.push_back(kind.name);
  return names;
}

std::vector<std::string> some_of(YamlMap& map, const char* key, const std::vector<std::string>& choices) {
  const auto list = map.find(key);
  if (!list) return choices;
  std::vector<std::string> chosen;
  for (const YamlValue& item : list->list()) chosen.push_back(item.choice(choices));
  if (chosen.empty()) list->fail("must name at least one");
  return chosen;
}

std::vector<int> read_counts(const YamlValue& value) {
  YamlMap map(value);
  std::vector<int> counts;
  for (const CaseKind kind : kCaseKinds) counts.push_back(int(map.integer(name(kind), 0, 0, 1000000)));
  map.finish();
  return counts;
}

std::size_t pick(RandomStream& random, std::size_t count) {
  return std::min(count - 1, std::size_t(random.uniform() * double(count)));
}

void shuffle(std::vector<std::string>& names, RandomStream& random) {
  for (std::size_t i = names.size(); i > 1; --i) std::swap(names[i - 1], names[pick(random, i)]);
}

}  // namespace

const char* name(CaseKind kind) {
  constexpr const char* kNames[] = {"none", "single", "pair", "triple", "outside", "excluded"};
  return kNames[int(kind)];
}

WorldsPlan read_worlds(const std::string& file) {
  YamlMap map(YamlValue::load(file));
  WorldsPlan plan;
  plan.file = file;
  map.at("format").choice({"umbsim-worlds/1"});
  plan.name = map.string("name", std::filesystem::path(file).stem().string());
  if (const std::string problem = run_id_problem(plan.name); !problem.empty()) map.at("name").fail(problem);
  plan.description = map.string("description", "");
  plan.seed = std::uint64_t(map.integer("seed", 1, 0, std::numeric_limits<std::int64_t>::max()));
  plan.engines = some_of(map, "engines", engine_names());
  plan.cases_per_engine = read_counts(map.at("cases_per_engine"));
  if (const auto value = map.find("severity")) {
    const std::vector<YamlValue> ends = value->list();
    if (ends.size() != 2) value->fail("must be [min, max]");
    plan.severity.min = ends[0].number(Bounds::positive());
    plan.severity.max = ends[1].number(Bounds::at_least(plan.severity.min));
  }
  plan.decoy_exclusions = map.number("decoy_exclusions", plan.decoy_exclusions, Bounds::between(0, 1));
  plan.choices.drivers = some_of(map, "drivers", names_in(kDriverKinds));
  plan.choices.trackers = some_of(map, "trackers", names_in(kTrackerKinds));
  plan.choices.runs = some_of(map, "runs", names_in(kRunSets));
  plan.choices.robots_folder = UMBSIM_ROBOTS_DIR;
  map.finish();
  return plan;
}

std::string resolved_worlds(const WorldsPlan& p) {
  std::string text =
      fmt::format("format: umbsim-worlds/1\nname: {}\ndescription: {}\nseed: {}\nengines: [{}]\ncases_per_engine:\n",
                  yaml_string(p.name), yaml_string(p.description), p.seed, fmt::join(p.engines, ", "));
  for (const CaseKind kind : kCaseKinds)
    text += fmt::format("  {}: {}\n", name(kind), p.cases_per_engine[std::size_t(kind)]);
  return text + fmt::format("severity: [{}, {}]\ndecoy_exclusions: {}\ndrivers: [{}]\ntrackers: [{}]\nruns: [{}]\n",
                            yaml_number(p.severity.min, "severity"), yaml_number(p.severity.max, "severity"),
                            yaml_number(p.decoy_exclusions, "decoy_exclusions"), fmt::join(p.choices.drivers, ", "),
                            fmt::join(p.choices.trackers, ", "), fmt::join(p.choices.runs, ", "));
}

std::vector<std::string> fault_names(const WorldsPlan& plan, const WorldCase& c) {
  if (c.kind == CaseKind::none) return {};
  std::vector<std::string> names;
  const EngineKind& engine = find_engine(c.engine);
  if (c.kind == CaseKind::outside) {
    for (const OutsideInfo& info : outside_effects()) names.push_back(info.name);
  } else {
    for (const EffectInfo& info : catalogue()) {
      if (engine.expresses.count(info.name)) names.push_back(info.name);
    }
  }
  RandomStream order(plan.seed, "worlds order " + c.engine, std::uint64_t(c.kind));
  shuffle(names, order);
  const std::size_t wanted = c.kind == CaseKind::pair ? 2 : c.kind == CaseKind::triple ? 3 : 1;
  std::rotate(names.begin(), names.begin() + std::ptrdiff_t(std::size_t(c.number) % names.size()), names.end());
  RandomStream others(plan.seed, "worlds others", c.index);
  std::vector<std::string> rest(names.begin() + 1, names.end());
  shuffle(rest, others);
  rest.resize(std::min(rest.size(), wanted - 1));
  rest.insert(rest.begin(), names.front());
  return rest;
}

namespace {

// The case's own effect where it is to be unknown; elsewhere now and then an innocent one, so that an exclusion by
// itself gives nothing away.
std::vector<std::string> exclusions(const WorldsPlan& plan, const WorldCase& c) {
  const std::vector<std::string> faults = fault_names(plan, c);
  if (c.kind == CaseKind::excluded) return faults;
  RandomStream random(plan.seed, "worlds decoy", c.index);
  const bool decoy = random.uniform() < plan.decoy_exclusions;
  const std::string& innocent = catalogue()[pick(random, catalogue().size())].name;
  if (!decoy || std::find(faults.begin(), faults.end(), innocent) != faults.end()) return {};
  return {innocent};
}

}  // namespace

std::vector<WorldCase> world_cases(const WorldsPlan& plan) {
  std::vector<WorldCase> cases;
  for (const CaseKind kind : kCaseKinds) {
    for (int number = 0; number < plan.cases_per_engine[std::size_t(kind)]; ++number) {
      for (const std::string& engine : plan.engines) {
        WorldCase c;
        c.index = cases.size();
        c.name = fmt::format("{:012x}", RandomStream(plan.seed, "worlds name", c.index).bits() & 0xffffffffffff);
        c.engine = engine;
        c.kind = kind;
        c.number = number;
        c.excluded = exclusions(plan, c);
        cases.push_back(c);
      }
    }
  }
  std::sort(cases.begin(), cases.end(), [](const WorldCase& a, const WorldCase& b) { return a.name < b.name; });
  return cases;
}

}  // namespace umbsim::worlds
