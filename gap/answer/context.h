#pragma once

#include <set>
#include <string>

#include "gap/answer/unknown.h"
#include "gap/search/search.h"

namespace umbsim::gap {

/// What all steps of an answer share.
struct Context {
  const Model& model;
  const Screen& screen;
  const std::set<std::string>& excluded;
  const Thresholds& thresholds;
  const Fit none;
  const LeftUnexplained left_by_none;
  const double none_log_evidence;  ///< of no effect; were all engines alike, if that is less: then a gap is no effect's

  /// Log evidence over no effect.
  double explained_by(const Fit& fit) const { return fit.log_evidence - none_log_evidence; }
  bool may_name(const std::string& effect) const { return excluded.count(effect) == 0; }
};

}  // namespace umbsim::gap
