#pragma once

#include "gap/trial/draw/severity.h"

namespace umbsim {

enum class Tier { no_effect, single, pairs, outside, end_points, poor_runs };
constexpr Tier kTiers[] = {Tier::no_effect, Tier::single,     Tier::pairs,
                           Tier::outside,   Tier::end_points, Tier::poor_runs};
const char* name(Tier tier);

/// A case as drawn, before its effects are scaled.
struct TrialCase {
  std::string name;  ///< random; says nothing of the order
  std::uint64_t index = 0;
  Tier tier = Tier::no_effect;
  int platform = 0;
  double noise_level = 1;
  std::uint64_t seed = 1;                   ///< of its drives
  std::vector<const EffectInfo*> effects;
  std::vector<double> severities;           ///< drawn, of each effect
  std::vector<std::string> excluded;        ///< from the diagnoser's catalogue
};

/// All cases of the trial, sorted by name. The n-th case depends on the plan alone.
std::vector<TrialCase> draw_cases(const TrialPlan& plan);

/// The runs that a case is driven with.
std::vector<PlannedRun> runs_of(const TrialPlan& plan, Tier tier);

}  // namespace umbsim
