#pragma once

#include <string>
#include <vector>

#include "bench/worlds/draw/plan.h"
#include "bench/worlds/run/fault.h"

namespace umbsim::worlds {

/// What the answers file says of a case: its effects with their severities, and under `world` all of its world.
Json answer_of(const World& world, const WorldScale& scale, CaseKind kind, const std::vector<std::string>& excluded,
               const std::vector<ScaledFault>& faults);

}  // namespace umbsim::worlds
