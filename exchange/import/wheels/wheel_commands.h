#pragma once

#include <string>
#include <utility>
#include <vector>

#include "exchange/import/log.h"

namespace umbsim::exchange {

/// Speeds of the left and the right wheel on the floor that a drive controller makes of the body's. A command that no
/// other follows within half a second (or three usual intervals, if those are longer) ends then, as
/// diff_drive_controller ends it; how many did is added to `found`.
std::pair<WheelSignal, WheelSignal> wheel_commands(const BodyCommands& commands, double wheelbase_m,
                                                   std::vector<std::string>& found);

}  // namespace umbsim::exchange
