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
      bullet_engine(),
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

EngineOptions middle_options(const EngineKind& kind) {
  EngineOptions options;
  for (const EngineOption& o : kind.options) {
    if (o.draw == EngineOption::Draw::choice)
      options.choices[o.name] = o.choices.front();
    else
      options.numbers[o.name] = o.draw == EngineOption::Draw::uniform ? (o.min + o.max) / 2 : std::sqrt(o.min * o.max);
  }
  return options;
}

}  // namespace umbsim::worlds
