#include "effects/catalogue.h"

#include <algorithm>

namespace umbsim {

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

Rig apply_effects(const std::vector<Effect>& effects, Rig rig) {
  for (const EffectInfo& info : catalogue()) {
    for (const Effect& effect : effects) {
      if (effect.info == &info) info.apply(effect.values, rig);
    }
  }
  return rig;
}

}  // namespace umbsim
