#pragma once

#include "experiment/scenario/scenario.h"
#include "umbmark/control_loop.h"

namespace umbsim {

/// How the driver's loop is timed. `rig`: as one of the scenario's runs has it.
LoopTiming loop_timing(const Scenario& scenario, const Rig& rig);

/// Throws InputError if the driver cannot hold its course at the rate at which it is run and with what its counts and
/// motors lag behind: which key is beyond which limit.
void check_control_loop(const Scenario& scenario, const Rig& rig);

}  // namespace umbsim
