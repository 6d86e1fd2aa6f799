#pragma once

#include <string>

#include "recording/recording.h"

namespace umbsim::exchange {

/// One table of all runs, a row a sample: blank cells where a row has no counts, or no pose. `umbsim import` reads it.
std::string samples_csv(const Recording& recording);

/// TUM trajectories, `time x y z qx qy qz qw`.
std::string truth_tum(const RecordedRun& run);
std::string odometry_tum(const RecordedRun& run, const RecordedRobot& robot);

}  // namespace umbsim::exchange
