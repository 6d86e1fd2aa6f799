#pragma once

#include <set>
#include <string>
#include <vector>

#include "gap/evidence/model.h"

namespace umbsim::gap {

/// A hypothesis of an effect as it is asked about before there are data.
struct PlannedHypothesis {
  Hypothesis hypothesis;
  bool happens = true;         ///< also tried as what is wrong; false: only as an explanation
  bool in_first_run = false;   ///< an event that takes place in the first run of whatever is driven
  bool by_run_number = false;  ///< grows in proportion to the number of runs before
  /// Where the simulator bends: value of the first parameter that hardly acts, and the strongest plausible one.
  double weak = 0;
  double strong = 0;
};

/// Every hypothesis of the catalogue's effects in `wanted`. Events stand for all of their kind: a cable lies under
/// the right wheel half way along the first leg of the first run, what takes the grip away lies at that leg's end, a
/// push comes half way along the second leg.
std::vector<PlannedHypothesis> planned_hypotheses(const Model& model, const std::set<std::string>& wanted);

/// Effects of `wanted` that no hypothesis stands for: the diagnosis cannot name them.
std::vector<std::string> without_hypothesis(const std::set<std::string>& wanted);

/// Whether all parameters of an effect lie within what is met on real robots.
bool plausible(const Effect& effect);

}  // namespace umbsim::gap
