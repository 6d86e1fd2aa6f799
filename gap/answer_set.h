#pragma once

#include <string>
#include <vector>

#include "gap/diagnose.h"

namespace umbsim::gap {

/// Names of the causes whose evidence hardly differs from the first one's once both are fitted.
std::vector<std::string> tied(const std::vector<Cause>& causes, const Thresholds& thresholds);

/// Adds an explanation to the set, and those of its effects that explain much of the same alone.
void add_what_explains(const Fit& best, const Fit& none, Diagnosis& d);

/// Adds the effects that counts and commands plainly show: they are there, whatever else there may be.
void add_what_counts_show(const Model& model, const Fit& none, const Thresholds& thresholds, Diagnosis& d);

}  // namespace umbsim::gap
