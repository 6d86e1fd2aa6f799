#pragma once

#include "gap/simulator.h"

namespace umbsim::gap {

/// The same simulator, which keeps the tracks and counts of the sets of effects that were asked for last: a fit starts
/// where a screen ended, and its steps come back as the next fit's start. Safe to call from several threads.
Simulator remembered(Simulator simulator);

}  // namespace umbsim::gap
