#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "gap/trial/draw/cases.h"
#include "gap/trial/write/trial_folder.h"

namespace umbsim {

/// The truth about one effect of a case.
struct TrueEffect {
  std::map<std::string, double> parameters;  ///< those that are not neutral
  std::string run;                           ///< for effects of one run
  std::optional<double> severity;            ///< in units of the noise floor
};

/// The truth about one case. Answers to cases made elsewhere need no more than `effects`.
struct Answer {
  Tier tier = Tier::no_effect;
  std::map<std::string, TrueEffect> effects;  ///< by name; a name outside the catalogue is allowed
  std::vector<std::string> excluded;
  bool undetectable_expected = false;

  /// Largest severity of the effects, if all are known.
  std::optional<double> severity() const;
};

/// By case name.
using Answers = std::map<std::string, Answer>;

/// Parameters of an effect that are not neutral, and its run.
Json effect_json(const Effect& effect);

/// What the answers file says of a generated case.
Json answer_json(const TrialCase& drawn, const std::vector<ScaledEffect>& effects);

/// Reads an answers file, JSON or YAML (docs/trial.md). Where `tier` is not given, it follows from the effects: none,
/// one, several; an effect that is excluded or not in the catalogue makes it `outside`. Throws InputError.
Answers read_answers(const std::filesystem::path& file);

}  // namespace umbsim
