#pragma once

#include <filesystem>

#include "experiment/output/result_json.h"

namespace umbsim {

/// What the page of a recording is made from, whatever robot it is of: the runs with their tracks, the odometry by the
/// nominal dimensions, the robot, and UMBmark figures where it holds squares both ways. Of a run's own result also its
/// summary and the runs that were driven again. Throws InputError.
Json recording_report_json(const std::filesystem::path& folder);

}  // namespace umbsim
