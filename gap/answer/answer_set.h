#pragma once

#include <map>
#include <string>
#include <vector>

#include "gap/answer/diagnosis.h"
#include "gap/search/thresholds.h"

namespace umbsim::gap {

/// Names of the causes whose evidence hardly differs from the first one's once both are fitted.
std::vector<std::string> tied(const std::vector<Cause>& causes, const Thresholds& thresholds);

/// Adds an explanation to the set, and those of its effects that explain much of the same alone.
void add_what_explains(const Fit& best, const Fit& none, Diagnosis& d);

/// Adds the effects that counts and commands plainly show: they are there, whatever else there may be.
void add_what_counts_show(const Model& model, const Fit& none, const Thresholds& thresholds, Diagnosis& d);

/// Adds what is not sure enough to be named, but more likely than not beside what is: where nothing is named, the
/// likeliest single effect that is too small; else the first cause with the likeliest effect more.
void add_doubtful(const std::vector<Fit>& doubtful, const Fit& none, Diagnosis& d);

/// Adds the single effect that shows most where none is named and nothing else is in the set, and the next if it hardly
/// shows less: smaller than anything that these runs can prove. `p_values`: of each effect.
void add_faint(const std::map<std::string, double>& p_values, const Thresholds& thresholds, Diagnosis& d);

}  // namespace umbsim::gap
