#pragma once

#include <string>
#include <vector>

#include "exchange/import/log.h"
#include "exchange/import/options.h"
#include "recording/recording.h"

namespace umbsim::exchange {

/// The whole log as one run: cumulative ticks from the wheels' numbers, the tracker's poses as those of the axle's
/// middle, seconds from the first stamp of both. Sets robot.ticks_per_revolution where the source has angles and the
/// options give none. What was done goes to `found`. Throws InputError: logs that do not overlap in time, with how far
/// they are apart.
RecordedRun whole_run(const Log& log, const ImportOptions& options, RecordedRobot& robot,
                      std::vector<std::string>& found);

}  // namespace umbsim::exchange
