#pragma once

#include <string>
#include <vector>

#include "exchange/import/log.h"
#include "exchange/import/options.h"
#include "recording/recording.h"

namespace umbsim::exchange {

/// The robot of the recording's header: from the options, else from the URDF of --robot. Where neither says a number it
/// is 0. Also fills in the options' joints and wheelbase from the URDF. What was taken goes to `found`. Throws
/// InputError of the URDF.
RecordedRobot robot_numbers(ImportOptions& options, std::vector<std::string>& found);

/// Throws InputError that asks for what is still missing, by option.
void require_numbers(const RecordedRobot& robot, const Log& log);

}  // namespace umbsim::exchange
