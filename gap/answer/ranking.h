#pragma once

#include <vector>

#include "gap/answer/diagnosis.h"
#include "gap/answer/unknown.h"
#include "gap/search/thresholds.h"

namespace umbsim::gap {

/// Combinations that bring too little over anything simpler are dropped: each further effect has to pay. The first fit
/// is that of no effect. `left_by_none`: what it leaves.
std::vector<Fit> worth_their_cost(const Model& model, std::vector<Fit> fits, const LeftUnexplained& left_by_none,
                                  const Thresholds& thresholds);

/// The best fit of every name, best first, with its variants. The first fit is that of no effect.
std::vector<Cause> ranked(const std::vector<Fit>& fits, const Thresholds& thresholds);

/// What predicts held-out runs worse than something that explains nearly as much gives way to it: worse than something
/// simpler, or worse by a noise floor than as many other effects that leave no more beyond noise than noise itself. Not
/// where counts and commands tell the two apart: they show what moves no track.
void prefer_what_predicts(const Model& model, std::vector<Cause>& causes, const Thresholds& thresholds);

/// Of explanations that are equally good, one goes first in which no contact takes part: it is the same on any floor.
void prefer_kinematic(std::vector<Cause>& causes);

/// From their scores, and from how often an answer is beside the truth whatever these say. `elsewhere`: this simulator
/// did not make the recording.
void give_probabilities(std::vector<Cause>& causes, bool elsewhere);

}  // namespace umbsim::gap
