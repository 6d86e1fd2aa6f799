#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/text/yaml_reader.h"
#include "effects/rig.h"

namespace umbsim {

enum class Stage { geometry, drivetrain, encoder, contact, floor, measurement };
const char* name(Stage stage);

/// One parameter of an effect. `neutral` is the value that changes nothing (for parameters that only say where or when:
/// the default).
struct EffectParameter {
  std::string name;
  std::string unit;  ///< "1" for a ratio
  double neutral = 0;
  Bounds bounds;             ///< outside: refused
  double plausible_min = 0;  ///< magnitudes met on real robots
  double plausible_max = 0;
  double typical = 0;  ///< shown in the effect's own scenario
};

/// What the catalogue says of an effect beside its parameters.
struct EffectText {
  std::string lecture;  ///< where the lecture lists it
  std::string source;
  std::string description;    ///< one line
  std::string signature;      ///< what it looks like in the data
  std::string confused_with;  ///< effects that look alike
};

/// Parameter values in the order of the table line; `run` for effects of one run only.
struct EffectValues {
  std::vector<double> numbers;
  std::string run;
};

/// One line of the catalogue.
struct EffectInfo {
  std::string name;
  Stage stage = Stage::geometry;
  std::vector<EffectParameter> parameters;
  EffectText text;
  bool one_run = false;  ///< takes the text parameter `run`
  std::function<void(const EffectValues& values, Rig& rig)> apply;
};

/// The one table of all effects, in the order in which they are applied.
const std::vector<EffectInfo>& catalogue();

/// Throws InputError with the list of names if there is no such effect.
const EffectInfo& find_effect(const std::string& name);

/// An effect with its parameter values.
struct Effect {
  const EffectInfo* info = nullptr;
  EffectValues values;
};

/// All parameters neutral.
Effect neutral_effect(const EffectInfo& info);

/// Reads the map `effects:`. Parameters that are left out are neutral. Throws InputError.
std::vector<Effect> read_effects(const YamlValue& value);

/// `believed` with `more` on top. An effect that both have has its parameters' departures from neutral added, within
/// their bounds; where 0 stands for the scenario's own the new value goes; effects of a place or of one run stand
/// beside each other.
std::vector<Effect> combined(std::vector<Effect> believed, const std::vector<Effect>& more);

/// Effects with their values as bytes: equal for equal effects alone.
std::string bytes_of(const std::vector<Effect>& effects);

/// The rig with all effects applied, in the order of the catalogue.
Rig apply_effects(const std::vector<Effect>& effects, Rig rig);

}  // namespace umbsim
