#pragma once

#include <set>
#include <string>
#include <vector>

#include "gap/answer/diagnosis.h"
#include "gap/plan/race.h"
#include "gap/search/thresholds.h"

namespace umbsim::gap {

/// Effects that a diagnosis could have mistaken for its first cause, by prediction for these very runs at the fitted
/// sizes.
struct Ties {
  std::size_t own = 0;                           ///< members that the first cause is made of: no rivals of each other
  std::vector<std::string> members;              ///< those, then effects tied with them or in the set
  std::vector<FixedTruth> sizes;                 ///< of each, as fitted or as near to the first as it comes
  std::vector<PlannedHypothesis> hypotheses;     ///< that `sizes` refer to, in the order of their signatures
  Eigen::MatrixXd information;                   ///< of their signatures in the recorded runs
  std::vector<std::vector<std::string>> groups;  ///< for `indistinguishable`, excluded effects as well
  std::vector<std::string> could_be;             ///< effects that would often be named as the first cause, for `set`
};

/// `alike`: mean probability of a mistake above which two effects are not told apart. An effect that was excluded is
/// listed in the groups where, were it the truth, the first cause would be named in its place: where that leaves less
/// than it takes to call the cause unknown. It is no member and not in the set, for nothing speaks for it.
Ties find_ties(const Model& model, const Diagnosis& diagnosis, const std::set<std::string>& excluded,
               const Thresholds& thresholds, double alike = 0.1);

/// Fills in what the diagnosis's first cause cannot be told from, and adds to its set what would often be named so:
/// what was not fitted at all, or is not far behind.
void add_ties(const Ties& ties, const Thresholds& thresholds, Diagnosis& diagnosis);

/// A kind of run that would tell tied effects apart.
struct NextExperiment {
  std::string run;
  std::vector<std::string> separates;
  double lead = 0;  ///< log evidence that it is expected to add, over the pairs that it separates
};

/// By the log evidence that is expected on top of that of the recorded runs. `menu`: a model of the menu's runs alone;
/// `labels`: of its runs, cw and ccw of one kind one after the other. Kinds that separate nothing are left out, the
/// best three are kept.
std::vector<NextExperiment> next_experiments(const Model& menu, const std::vector<std::string>& labels,
                                             const Ties& ties, const Thresholds& thresholds);

}  // namespace umbsim::gap
