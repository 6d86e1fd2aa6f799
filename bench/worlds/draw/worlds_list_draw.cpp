// Listed cases, drawn like the others.
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <mutex>

#include "bench/worlds/draw/answer.h"
#include "bench/worlds/draw/worlds_list.h"
#include "core/error.h"
#include "core/text/yaml_text.h"

namespace umbsim::worlds {
namespace {

/// Severities on each platform, from when a case first asks for them.
class PlatformScales {
 public:
  explicit PlatformScales(const WorldsList& list) : list_(list) {
    for (const auto& [name, world] : list.worlds) platforms_[name] = std::make_unique<Platform>();
  }
  const WorldScale& of(const std::string& name) {
    Platform& p = *platforms_.at(name);
    std::call_once(p.once, [&] { make(name, p); });
    return *p.scale;
  }

 private:
  struct Platform {
    std::once_flag once;
    std::unique_ptr<World> guide;
    std::unique_ptr<WorldScale> scale;
  };
  void make(const std::string& name, Platform& p) const {
    const World& world = list_.worlds.at(name);
    const std::uint64_t seed = RandomStream(list_.seed, "worlds listed platform " + name).bits() >> 1;
    try {
      p.guide = std::make_unique<World>(guide_of(world));
      p.scale = std::make_unique<WorldScale>(world, *p.guide, seed);
      if (!drives(world, p.scale->nominal())) throw RunError("it does not get round its course");
    } catch (const std::runtime_error& e) {
      throw RunError(
          fmt::format("platform {} in {}: the nominal robot cannot be driven: {}", name, world.engine->name, e.what()));
    }
  }

  const WorldsList& list_;
  std::map<std::string, std::unique_ptr<Platform>> platforms_;
};

CaseKind kind_of(const ListedCase& c) {
  const std::size_t count = c.faults.effects.size() + c.faults.outside.size();
  if (count == 0) return CaseKind::none;
  if (!c.faults.outside.empty()) return CaseKind::outside;
  for (const Effect& e : c.faults.effects) {
    if (std::find(c.excluded.begin(), c.excluded.end(), e.info->name) != c.excluded.end()) return CaseKind::excluded;
  }
  return count == 1 ? CaseKind::single : count == 2 ? CaseKind::pair : CaseKind::triple;
}

std::vector<ScaledFault> faults_of(const ListedCase& c, const WorldScale& scale) {
  std::vector<ScaledFault> faults;
  for (const Effect& e : c.faults.effects) faults.push_back({e.info->name, {{e}, {}}, {}, {}});
  for (const OutsideEffect& e : c.faults.outside) faults.push_back({e.info->name, {{}, {e}}, {}, {}});
  for (ScaledFault& f : faults) {
    f.seen = scale.severity(f.faults);
    if (!std::isfinite(f.seen.severity))
      throw RunError(fmt::format("case {}: the robot cannot be driven with {}", c.given_name, f.name));
  }
  return faults;
}

DrawnCase draw_listed(const WorldsList& list, const ListedCase& c, const WorldScale& scale) {
  DrawnCase drawn;
  drawn.world = list.worlds.at(c.platform);
  const std::uint64_t seed = RandomStream(list.seed, "worlds listed case " + c.given_name).bits() >> 1;
  const std::vector<ScaledFault> faults = faults_of(c, scale);
  try {
    const DrivenWorld driven = drive_world(drawn.world, {c.faults, drawn.world.noise, seed, 1});
    drawn.recording = record(drawn.world, driven, seed);
    drawn.answer = answer_of(drawn.world, scale, kind_of(c), c.excluded, faults);
    drawn.answer["world"]["steps"] = driven.steps;
  } catch (const std::runtime_error& e) {
    throw RunError(fmt::format("case {}: {}", c.given_name, e.what()));
  }
  drawn.answer["world"]["listed"] = c.given_name;
  return drawn;
}

}  // namespace

// The folder says which list it holds, not what the list says: that is sealed.
DrawSource source_of(const WorldsList& list) {
  DrawSource source;
  source.name = list.name;
  source.seed = list.seed;
  source.worlds_yaml =
      fmt::format("format: umbsim-worlds-list/1\nname: {}\ndescription: {}\nseed: {}\nlist_sha256: {}\n",
                  yaml_string(list.name), yaml_string(list.description), list.seed, list.sha256);
  for (const ListedCase& c : list.cases) source.cases.push_back({c.name, c.excluded});
  const auto scales = std::make_shared<PlatformScales>(list);
  source.draw = [&list, scales](std::size_t index) {
    const ListedCase& c = list.cases[index];
    return draw_listed(list, c, scales->of(c.platform));
  };
  return source;
}

}  // namespace umbsim::worlds
