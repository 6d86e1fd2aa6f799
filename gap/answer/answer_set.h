#pragma once

#include <map>
#include <string>
#include <vector>

#include "gap/answer/context.h"
#include "gap/answer/diagnosis.h"

namespace umbsim::gap {

/// Names of the causes whose evidence hardly differs from the first one's once both are fitted.
std::vector<std::string> tied(const std::vector<Cause>& causes, const Thresholds& thresholds);

/// Adds what is not sure enough to be named, but more likely than not beside what is: where nothing is named, the
/// likeliest single effect that is too small; else the first cause with the likeliest effect more.
void add_doubtful(const std::vector<Fit>& doubtful, const Fit& none, Diagnosis& d);

/// Adds the single effect that shows most where none is named and nothing else is in the set, and the next if it hardly
/// shows less: smaller than anything that these runs can prove. `p_values`: of each effect.
void add_faint(const std::map<std::string, double>& p_values, const Thresholds& thresholds, Diagnosis& d);

/// The set: all that these runs do not tell from the first cause, or that they show beside it. `left`: by `best`, the
/// best explanation.
void fill_set(const Context& context, const Found& found, const LeftUnexplained& left, const Fit& best, Diagnosis& d);

}  // namespace umbsim::gap
