#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "batch/shard.h"
#include "batch/store/store.h"
#include "experiment/sweep/sweep.h"

namespace umbsim {

struct SweepOptions {
  std::filesystem::path folder;
  int jobs = 0;               ///< points driven at the same time; 0: one per core
  Shard shard;
  bool force = false;         ///< begin anew
  bool retry_failed = false;  ///< drive the failed points again
};

/// The database of a sweep in its folder: sweep.sqlite, or that of a shard.
std::filesystem::path store_file(const std::filesystem::path& folder, const Shard& shard);
/// The databases of shards in a folder, sorted.
std::vector<std::filesystem::path> shard_files(const std::filesystem::path& folder);

/// Drives what is missing of a sweep, or of a shard of it, and keeps every point in the store as soon as it is done.
/// Points do not depend on `jobs`, shards or interruptions. Returns the signal that ended it early; 0: all done. Throws
/// InputError before anything is written, RunError.
int run_sweep(const Sweep& sweep, const SweepOptions& options);

/// The points of all shards in one store, as one process would have left it. Throws InputError.
void merge_sweep(const Sweep& sweep, const std::filesystem::path& folder);

/// What the store of this sweep must be.
StoreLayout layout_of(const Sweep& sweep);

}  // namespace umbsim
