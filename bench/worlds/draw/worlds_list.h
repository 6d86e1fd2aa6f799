#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "bench/worlds/draw/draw.h"

namespace umbsim::worlds {

/// One recording to be made, with nothing left to chance but noise.
struct ListedCase {
  std::string given_name;  ///< by the list
  std::string name;        ///< random, in the folder
  std::string platform;
  Faults faults;
  std::vector<std::string> excluded;  ///< from the diagnoser's catalogue
};

/// Cases that are listed one by one: a file of the format umbsim-worlds-list/1 (docs/worlds.md).
struct WorldsList {
  std::string name;
  std::string description;
  std::uint64_t seed = 1;
  std::string sha256;                   ///< of the file
  std::map<std::string, World> worlds;  ///< by platform
  std::vector<ListedCase> cases;        ///< sorted by random name
};

/// As strict as a scenario. Throws InputError with file, line, column, key, value and bound.
WorldsList read_worlds_list(const std::string& file);

/// Of the same form as drawn worlds. Refers to `list`. A platform whose nominal robot cannot be driven, and a case that
/// cannot, throw RunError.
DrawSource source_of(const WorldsList& list);

}  // namespace umbsim::worlds
