#pragma once

#include <map>
#include <string>
#include <vector>

#include "bench/worlds/learn/case_shares.h"
#include "gap/traits/signature_errors.h"

namespace umbsim::worlds {

/// Errors of an effect's signature with what they were learned from.
struct LearnedErrors {
  gap::SignatureErrors errors;
  std::size_t cases = 0;
  double gain = 0;  ///< log density that they bring on these cases over a signature that is exact
};

/// Standard deviations by part, of counts and of single motions that make all cases of an effect likeliest, on a grid
/// of ten values. Each is thought to be a tenth within a factor of three before: where the data say nothing it is that.
LearnedErrors learned(const std::vector<CaseShares>& cases);

/// By effect.
std::map<std::string, LearnedErrors> learned_by_effect(const std::vector<CaseShares>& cases);

}  // namespace umbsim::worlds
