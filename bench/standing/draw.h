#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "experiment/scenario/scenario.h"

namespace umbsim {

/// The URDFs of a folder that load as differential drives, by name.
std::vector<std::filesystem::path> drivable_robots(const std::filesystem::path& folder);

/// Scenario `index` of a seed: a robot, a course in proportion to its size, one run each way, an effect or two within
/// their plausible ranges; odd ones on an uneven floor of up to 2 mm. The acceleration is below nine tenths of what the
/// robot stands, as a careful user's.
Scenario draw_scenario(const std::vector<std::filesystem::path>& robots, std::uint64_t seed, int index);

}  // namespace umbsim
