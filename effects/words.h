#pragma once

#include <map>
#include <string>
#include <vector>

#include "effects/catalogue.h"

namespace umbsim {

/// A number of an effect as it was found: SI, with its 95 % interval (both ends equal: none).
struct FoundParameter {
  std::string name;
  double value = 0;
  double low = 0;
  double high = 0;
};

/// A parameter for a reader.
struct ParameterWords {
  std::string name;
  std::string label;  ///< what it is called; empty where the effect's name says it
  std::string unit;   ///< that it is shown in
};

/// An effect for a reader.
struct EffectWords {
  std::string effect;
  std::string noun;                   ///< as in "cannot be told from ..."
  std::vector<std::string> sentence;  ///< its clauses, see found_sentence()
  std::vector<ParameterWords> parameters;
};

/// The one table of words, a line for each effect of the catalogue.
const std::vector<EffectWords>& words();
const EffectWords& words_of(const EffectInfo& info);

/// What stands for a parameter wherever a reader sees it: "radius 30 mm (26 to 34 mm)"; the digits are those that the
/// interval leaves.
std::string shown(const EffectInfo& info, const FoundParameter& found);

/// Whether it is what changes nothing, so that there is nothing to show.
bool is_neutral(const EffectInfo& info, const FoundParameter& found);

/// The effect as a sentence without its full stop, from the clauses of the table. In a clause {p} stands for a
/// parameter with its interval, {|p|} for its size, {~p} for its value alone, {=p} for its number without a unit,
/// {p?a|b} for a where it is positive and b where it is negative, and any key of `facts` for its text. What stands in
/// [] is left out where a parameter in it is neutral, or a fact is not known; clauses that are not empty are joined.
std::string found_sentence(const EffectInfo& info, const std::vector<FoundParameter>& found,
                           const std::map<std::string, std::string>& facts = {});

}  // namespace umbsim
