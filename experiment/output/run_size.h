#pragma once

#include <filesystem>

#include "experiment/scenario/scenario.h"

namespace umbsim {

/// How much an experiment is, before it is driven.
struct RunSize {
  int runs = 0;  ///< of one pass, those with cables too
  int laps = 0;  ///< of each
  double simulated_s = 0;
  double bytes = 0;  ///< of its rows on the disk
};

/// With one calibration pass, where it calibrates.
RunSize expected_size(const Scenario& scenario);

/// Says on a terminal how much it is, if it is much. Throws RunError if there is no room for it.
void check_room(const RunSize& size, const std::filesystem::path& folder);

}  // namespace umbsim
