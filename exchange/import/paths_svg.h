#pragma once

#include <string>

#include "recording/recording.h"

namespace umbsim::exchange {

/// A picture of all runs in the floor frame: what the tracker saw, and the odometry by the header's numbers from the
/// same start.
std::string paths_svg(const Recording& recording);

}  // namespace umbsim::exchange
