#pragma once

#include <set>
#include <string>

#include "gap/answer/unknown.h"
#include "gap/search/search.h"

namespace umbsim::gap {

/// What all steps of an answer share.
struct Context {
  const Model& model;
  /// In which it is asked what a cause leaves: the same, or one in which engines differ by little.
  const Model* judge;
  const Screen& screen;
  const std::set<std::string>& excluded;
  const Thresholds& thresholds;
  const Fit none;
  const LeftUnexplained left_by_none;
  /// Of no effect, under whichever says less: this model, or one in which engines differ by little. What engines may
  /// differ by takes a gap up, and a cause explains that gap all the same.
  const double none_log_evidence;

  /// Log evidence over no effect.
  double explained_by(const Fit& fit) const {
    if (judge == &model) return fit.log_evidence - none_log_evidence;
    return judge->held_density(fit) - judge->held_density(none);
  }
  bool may_name(const std::string& effect) const { return excluded.count(effect) == 0; }
};

}  // namespace umbsim::gap
