#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibration/compare/compare.h"

namespace umbsim::calibration {

/// Runs that are left out together, and what is then fitted to.
struct Fold {
  Runs left_out;
  Runs others;
  std::optional<std::size_t> run;  ///< the only run left out: a fit may know its answer without it
};

struct Folds {
  std::vector<Fold> all;
  std::string said;               ///< how they were made, in words
  std::vector<Recording> halves;  ///< of runs that were cut for it; folds point into them
};

/// One fold for each condition, both directions of it together; for each run where there is one condition only; for
/// each half of all runs where no run was repeated.
Folds folds_of(const Runs& runs);

/// Fills `held_out_mm`, its errors fold by fold, and `held_out_answers` of every result.
void leave_out(const Folds& folds, const OdometryParameters& nominal, std::vector<MethodResult>& results);

/// The result to trust, by held-out errors, and why in words.
std::pair<std::size_t, std::string> choose(const std::vector<MethodResult>& results, const Folds& folds);

}  // namespace umbsim::calibration
