#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "gap/plan/race.h"
#include "gap/search/thresholds.h"

namespace umbsim::gap {

struct PlanOptions {
  std::set<std::string> effects;  ///< to be told apart
  double severity = 3;            ///< of each, in noise floors of the runs that are asked about
  double alike = 0.1;             ///< probability of naming one for the other, mean of both ways, above which they are
  double shown = 0.5;             ///< probability of being found at all, below which an effect is not shown
  double least = 0.5;             ///< severity below which an effect does not count: it cannot be expected to show
  int draws = 400;
  std::uint64_t seed = 1;
};

using Pair = std::pair<std::string, std::string>;

/// What a set of runs can tell apart.
struct Separation {
  Race race;
  std::vector<std::pair<Pair, double>> alike;    ///< with the probability of a mistake
  std::vector<std::vector<std::string>> groups;  ///< that such pairs join together
  std::vector<std::string> not_shown;
  int separated = 0;  ///< pairs of effects that are both shown and not alike, of those that can be expected to show
  double soft = 0;    ///< the same as a sum of probabilities
};

Separation separation(Race race, const PlanOptions& options);

/// One run of a recommendation and what it adds.
struct PlanStep {
  std::size_t run = 0;
  std::vector<Pair> separates;     ///< pairs that the runs before it leave alike or do not show
  std::vector<std::string> shows;  ///< effects that they do not show
};

struct Recommendation {
  std::vector<PlanStep> steps;
  Separation result;
};

struct Plan {
  Separation given;                        ///< of the runs that are asked about
  Recommendation from_nothing;             ///< the shortest set of runs of the menu
  Recommendation further;                  ///< runs of the menu on top of those that are asked about
  std::vector<std::string> no_hypothesis;  ///< effects that the diagnosis cannot name
  std::vector<std::pair<std::string, double>>
      weak;  ///< effects that no plausible size brings to the severity, with theirs
};

/// Predicts before any data what the first `given` runs of a model tell apart, and picks from the others. The poses of
/// the model's recording do not matter; its noise does.
Plan plan(
    const Model& model, std::size_t given, double radius_scatter, const PlanOptions& options,
    const ProgressCallback& progress = [](const std::string&, double) {});

}  // namespace umbsim::gap
