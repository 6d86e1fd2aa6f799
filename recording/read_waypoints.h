#pragma once

#include <vector>

#include "core/text/yaml_reader.h"
#include "recording/recording.h"

namespace umbsim {

/// A list of places, [x, y] each, in metres. `place_m`: bounds of either. Throws InputError.
std::vector<Waypoint> read_waypoints(const YamlValue& value, const Bounds& place_m);

}  // namespace umbsim
