#pragma once

#include <string>
#include <vector>

#include "gap/replay/simulator.h"
#include "recording/recording.h"

namespace umbsim::gap {

/// The same simulator, which keeps the tracks and counts of the sets of effects that were asked for last: a fit starts
/// where a screen ended, and its steps come back as the next fit's start. Effects at a place where a run never came, or
/// of another run, are left out: they change nothing. Safe to call from several threads.
Simulator remembered(Simulator simulator, const Recording& recording);

}  // namespace umbsim::gap
