#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/yaml_reader.h"
#include "effects/rig.h"

namespace umbsim {

enum class Stage { geometry, drivetrain, encoder, contact, floor, measurement };
const char* name(Stage stage);

/// One parameter of an effect. `neutral` is the value that changes nothing.
struct EffectParameter {
  std::string name;
  std::string unit;  ///< "1" for a ratio
  double neutral = 0;
  Bounds bounds;     ///< outside: refused
  double plausible_min = 0;  ///< magnitudes met on real robots
  double plausible_max = 0;
};

/// One line of the catalogue.
struct EffectInfo {
  std::string name;
  Stage stage = Stage::geometry;
  std::string lecture;  ///< where the lecture lists it: systematic or non-systematic, and as what
  std::vector<EffectParameter> parameters;
  std::string source;
  std::string description;
  std::function<void(const std::vector<double>& values, Rig& rig)> apply;
};

/// The one table of all effects, in the order in which they are applied.
const std::vector<EffectInfo>& catalogue();

/// Throws InputError with the list of names if there is no such effect.
const EffectInfo& find_effect(const std::string& name);

/// An effect with its parameter values, in the order of its table line.
struct Effect {
  const EffectInfo* info = nullptr;
  std::vector<double> values;
};

/// Reads the map `effects:`. Parameters that are left out are neutral. Throws InputError.
std::vector<Effect> read_effects(const YamlValue& value);

/// The rig with all effects applied, in the order of the catalogue.
Rig apply_effects(const std::vector<Effect>& effects, Rig rig);

}  // namespace umbsim
