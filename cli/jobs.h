#pragma once

#include <tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <cstddef>

namespace umbsim {

/// Threads of one command: `-j`, else UMBSIM_JOBS of the environment, which a trial gives to the diagnoses that it
/// starts; 0: one per core. Results do not depend on it.
inline void add_threads_option(CLI::App& command, int& jobs) {
  command.add_option("-j,--jobs", jobs, "Threads; 0: one per core")->check(CLI::Range(0, 1024))->envname("UMBSIM_JOBS");
}

/// From now on nothing in the program takes more threads than this; 0: one per core.
struct ThreadLimit {
  explicit ThreadLimit(int jobs) {
    // Never taken back: a limit that ends wakes a further thread before the program does.
    if (jobs > 0) new tbb::global_control(tbb::global_control::max_allowed_parallelism, std::size_t(jobs));
  }
};

}  // namespace umbsim
