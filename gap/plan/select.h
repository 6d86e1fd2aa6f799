#pragma once

#include <functional>

#include "gap/plan/plan.h"

namespace umbsim::gap {

/// What a set of runs separates.
using Judge = std::function<Separation(const std::vector<std::size_t>& runs)>;

/// Greedy: adds the run that separates most until as many pairs are separated as by all candidates together or no run
/// adds a pair, then leaves out every run without which as many are. `base`: runs that are there already.
Recommendation select_runs(const std::vector<std::size_t>& base, const std::vector<std::size_t>& candidates,
                           const Judge& judge);

}  // namespace umbsim::gap
