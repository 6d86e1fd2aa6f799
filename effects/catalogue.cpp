#include "effects/catalogue.h"

#include <algorithm>

namespace umbsim {
namespace {

bool has_place(const EffectInfo& info) {
  return std::any_of(info.parameters.begin(), info.parameters.end(),
                     [](const EffectParameter& p) { return p.name == "x_m"; });
}

// Where 0 stands for the scenario's own value.
bool replaces(const EffectInfo& info) {
  return info.name == "slippery_floor" || info.name == "encoder_resolution" || info.name == "encoder_sampling";
}

}  // namespace

const char* name(Stage stage) {
  constexpr const char* kNames[] = {"geometry", "drivetrain", "encoder", "contact", "floor", "measurement"};
  return kNames[int(stage)];
}

const EffectInfo& find_effect(const std::string& name) {
  std::vector<std::string> names;
  for (const EffectInfo& info : catalogue()) {
    if (info.name == name) return info;
    names.push_back(info.name);
  }
  throw InputError("unknown effect '" + name + "'; " + list_choices(name, names));
}

Effect neutral_effect(const EffectInfo& info) {
  Effect effect{&info, {}};
  for (const EffectParameter& p : info.parameters) effect.values.numbers.push_back(p.neutral);
  return effect;
}

std::vector<Effect> read_effects(const YamlValue& value) {
  std::vector<Effect> effects;
  YamlMap map(value);
  for (const EffectInfo& info : catalogue()) {
    const auto entry = map.find(info.name);
    if (!entry) continue;
    YamlMap parameters(*entry);
    Effect effect{&info, {}};
    for (const EffectParameter& p : info.parameters) {
      effect.values.numbers.push_back(parameters.number(p.name, p.neutral, p.bounds));
    }
    if (info.one_run) effect.values.run = parameters.string("run", "");
    parameters.finish();
    effects.push_back(std::move(effect));
  }
  map.finish();
  return effects;
}

std::vector<Effect> combined(std::vector<Effect> believed, const std::vector<Effect>& more) {
  for (const Effect& e : more) {
    const auto there =
        std::find_if(believed.begin(), believed.end(), [&](const Effect& b) { return b.info == e.info; });
    if (there == believed.end() || e.info->one_run || has_place(*e.info)) {
      believed.push_back(e);
    } else if (replaces(*e.info)) {
      *there = e;
    } else {
      for (std::size_t i = 0; i < e.values.numbers.size(); ++i) {
        const EffectParameter& p = e.info->parameters[i];
        double& x = there->values.numbers[i];
        x = std::clamp(x + e.values.numbers[i] - p.neutral, p.bounds.min, p.bounds.max);
      }
    }
  }
  return believed;
}

Rig apply_effects(const std::vector<Effect>& effects, Rig rig) {
  for (const EffectInfo& info : catalogue()) {
    for (const Effect& effect : effects) {
      if (effect.info == &info) info.apply(effect.values, rig);
    }
  }
  return rig;
}

std::string bytes_of(const std::vector<Effect>& effects) {
  std::string bytes;
  for (const Effect& e : effects) {
    bytes += e.info->name + '\0' + e.values.run + '\0';
    bytes.append(reinterpret_cast<const char*>(e.values.numbers.data()), e.values.numbers.size() * sizeof(double));
  }
  return bytes;
}

}  // namespace umbsim
