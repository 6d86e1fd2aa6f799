#pragma once

#include <map>
#include <string>

#include "bench/worlds/world/world.h"
#include "core/text/yaml_reader.h"

namespace umbsim::worlds {

/// The keys of a list that describe its worlds: engine, options, physics, driver, tracker, noise, runs, platforms. By
/// platform. Throws InputError.
std::map<std::string, World> read_listed_worlds(YamlMap& map);

}  // namespace umbsim::worlds
