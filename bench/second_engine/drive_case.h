#pragma once

#include "bench/second_engine/engine_options.h"
#include "gap/trial/severity.h"

namespace umbsim::second_engine {

/// The planned runs, driven in MuJoCo. Throws RunError where a robot cannot be driven so.
Recording drive_case(const EngineOptions& options, const TrialDrive& drive);

}  // namespace umbsim::second_engine
