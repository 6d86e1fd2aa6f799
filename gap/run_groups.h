#pragma once

#include <cstddef>
#include <vector>

#include "recording/recording.h"

namespace umbsim::gap {

/// Runs of the same speed, payload and kind of turn, whatever their direction and start heading: what an engine, or a
/// robot, does otherwise than the simulator it does alike in these.
struct RunGroups {
  std::vector<bool> rolling;          ///< whether turns are arcs, of each group
  std::vector<std::size_t> group_of;  ///< each run
};

RunGroups grouped(const Recording& recording);

}  // namespace umbsim::gap
