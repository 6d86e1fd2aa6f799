// The engines of the proving ground, one line each. A new engine is its file in engines/ and its line here.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/worlds/engines/kinds.h"
#include "core/error.h"

namespace umbsim::worlds {

const std::vector<EngineKind>& engines() {
  static const std::vector<EngineKind> table = {
      our_engine(),
      planar_engine(),
#ifdef UMBSIM_WORLDS_MUJOCO
      mujoco_engine(),
#endif
  };
  return table;
}

const EngineKind& find_engine(const std::string& name) {
  std::string names;
  for (const EngineKind& kind : engines()) {
    if (kind.name == name) return kind;
    names += (names.empty() ? "" : ", ") + kind.name;
  }
#ifndef UMBSIM_WORLDS_MUJOCO
  if (name == "mujoco") throw InputError("engine 'mujoco': this program was built without libmujoco-dev");
#endif
  throw InputError(fmt::format("no engine '{}'; this build has {}", name, names));
}

EngineOptions draw_options(const EngineKind& kind, RandomStream& random) {
  EngineOptions drawn;
  for (const EngineOption& o : kind.options) {
    const double u = random.uniform();
    switch (o.draw) {
      case EngineOption::Draw::uniform:
        drawn.numbers[o.name] = o.min + u * (o.max - o.min);
        break;
      case EngineOption::Draw::log_uniform:
        drawn.numbers[o.name] = o.min * std::pow(o.max / o.min, u);
        break;
      case EngineOption::Draw::choice:
        drawn.choices[o.name] = o.choices[std::min(o.choices.size() - 1, std::size_t(u * double(o.choices.size())))];
        break;
    }
  }
  return drawn;
}

}  // namespace umbsim::worlds
