#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "gap/replay/simulator.h"
#include "recording/recording.h"

namespace umbsim::gap {

/// Where simulated tracks are kept from one call of the program to the next.
struct CacheChoice {
  std::optional<std::filesystem::path> folder;  ///< none: nothing is kept
  std::uint64_t max_bytes = 1ull << 30;         ///< of all files together; the oldest go first
};

/// $XDG_CACHE_HOME/umbsim/signatures, else ~/.cache/umbsim/signatures; none without either.
std::optional<std::filesystem::path> user_cache_folder();

/// The same simulator, which reads what an earlier call of the program simulated (within one, gap/replay/remembered.h
/// does). What it returns is the same bytes as without. `identity`: everything but the recording that the tracks depend
/// on: program, robot, scenario. A file is written beside and renamed, and read only if its checksum is right, so
/// several processes may share a folder and a broken file is computed again. A folder that cannot be written is done
/// without.
Simulator cached(Simulator simulator, const Recording& recording, const std::string& identity,
                 const CacheChoice& choice);

}  // namespace umbsim::gap
