#pragma once

#include <string>
#include <vector>

#include "exchange/import/options.h"
#include "recording/recording.h"

namespace umbsim::exchange {

/// Whether the tracked frame sits on the axle's middle and looks ahead, as a recording's truth must: where it lies on
/// the body, by least squares of its way on what the wheels rolled and turned. Throws InputError where its heading is
/// clearly another; says in `remarks` where it lies where that is clear. Both name --mount.
void check_mount(const Recording& recording, const ImportOptions& options, std::vector<std::string>& remarks);

}  // namespace umbsim::exchange
