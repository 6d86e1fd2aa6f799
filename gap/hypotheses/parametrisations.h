#pragma once

#include <string>
#include <utility>
#include <vector>

#include "gap/hypotheses/hypothesis.h"

namespace umbsim::gap {

/// Place of a parameter among an effect's numbers.
std::size_t index_of(const EffectInfo& info, const std::string& parameter);

/// A hypothesis whose free numbers are parameters of the effect as they are; others at `fixed`, or neutral.
Hypothesis direct(const std::string& effect, const std::string& variant, std::vector<FreeParameter> parameters,
                  const std::vector<std::pair<std::string, double>>& fixed = {});

/// A size and a direction, fitted as two components.
Hypothesis vector_hypothesis(const std::string& effect, const std::string& size, const std::string& angle, double step,
                             double prior_sd, double limit);

/// A number that counts in proportion: fitted as the logarithm of its ratio to `unit`.
Hypothesis logarithmic(const std::string& effect, const std::string& parameter, double unit, double prior_sd,
                       double min, double max);

/// A size that acts by its square: fitted as that. `most`: the largest possible; 0: as the catalogue says.
Hypothesis squared(const std::string& effect, const std::string& parameter, double step, double prior_sd, double most);

}  // namespace umbsim::gap
