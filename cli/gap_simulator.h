#pragma once

#include <string>

#include "experiment/replay.h"
#include "gap/signature_cache.h"

namespace umbsim {

/// The replay as gap/ asks for it.
gap::Simulator gap_simulator(const Replay& replay);

/// The same, with its tracks kept in the user's cache folder; `no_cache`: only while the program runs.
gap::Simulator cached_gap_simulator(const Replay& replay, bool no_cache);

}  // namespace umbsim
