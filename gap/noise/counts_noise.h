#pragma once

#include <Eigen/Core>
#include <vector>

#include "gap/replay/command_response.h"
#include "gap/replay/run_groups.h"
#include "recording/command_features.h"
#include "recording/recording.h"

namespace umbsim::gap {

/// With what counts against commands are measured in a run, standard deviations: left gain, right gain, lag (s), speed
/// along the cosine and the sine of the heading (rad/s). Zeros where they are not known.
using CountsSd = Eigen::Matrix<double, 5, 1>;

/// Standard deviations with which command features are measured. What keeps a robot on its course makes up for motors
/// that lag: its commands rise more steeply than was asked for, and say the less of the commanded motion the more
/// counts lag behind them.
CommandFeatures command_features_sd(const Recording& recording, const std::vector<CommandResponse>& measured,
                                    const std::vector<CommandResponse>& foretold);

/// Standard deviation of the gains of counts over commands from run to run, by the differences of runs of one group
/// (RunGroups), which say it as well as eight runs that scatter as `usual`; no less than `usual`.
double gain_scatter(const RunGroups& groups, const std::vector<CommandResponse>& measured,
                    const std::vector<CommandResponse>& foretold, double usual);

}  // namespace umbsim::gap
