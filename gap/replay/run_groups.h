#pragma once

#include <cstddef>
#include <vector>

#include "gap/replay/campaign.h"

namespace umbsim::gap {

/// Runs of the same speed, payload and kind of turn, whatever their direction and start heading: what an engine, or a
/// robot, does otherwise than the simulator it does alike in these. Each recording of a campaign has its own.
struct RunGroups {
  std::vector<bool> rolling;          ///< whether turns are arcs, of each group
  std::vector<std::size_t> group_of;  ///< each run
};

RunGroups grouped(const std::vector<RecordedRun>& runs, const std::vector<const Recording*>& origin);
RunGroups grouped(const Recording& recording);

}  // namespace umbsim::gap
