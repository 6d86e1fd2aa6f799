#pragma once

#include <vector>

#include "gap/replay/command_features.h"
#include "gap/replay/run_groups.h"
#include "recording/habits.h"
#include "recording/recording.h"

namespace umbsim::gap {

/// Standard deviations with which habits are measured. What keeps a robot on its course makes up for motors that lag:
/// its commands rise more steeply than was asked for, and say the less of the demand the more counts lag behind them.
Habits habits_sd(const Recording& recording, const std::vector<CommandFeatures>& measured,
                 const std::vector<CommandFeatures>& foretold);

/// Standard deviation of the gains of counts over commands from run to run, by the differences of runs of one group
/// (RunGroups), which say it as well as eight runs that scatter as `usual`; no less than `usual`.
double gain_scatter(const RunGroups& groups, const std::vector<CommandFeatures>& measured,
                    const std::vector<CommandFeatures>& foretold, double usual);

}  // namespace umbsim::gap
