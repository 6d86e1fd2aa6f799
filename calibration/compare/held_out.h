#pragma once

#include <string>
#include <vector>

#include "calibration/compare/compare.h"

namespace umbsim::calibration {

/// Runs that are left out together.
struct Fold {
  std::vector<std::size_t> left_out;
};

struct Folds {
  std::vector<Fold> all;
  std::string said;  ///< how they were made, in words
};

/// One fold for each condition, both directions of it together; for each run where there is one condition only.
Folds folds_of(const Runs& runs);

/// Fills `held_out_mm` and `held_out_answers` of every result.
void leave_out(const Runs& runs, const Folds& folds, const OdometryParameters& nominal,
               std::vector<MethodResult>& results);

/// The result to trust, by held-out errors, and why in words.
std::pair<std::size_t, std::string> choose(const std::vector<MethodResult>& results, const Folds& folds);

}  // namespace umbsim::calibration
