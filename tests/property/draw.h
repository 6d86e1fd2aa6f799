#pragma once

#include <cstdint>
#include <string>

namespace umbsim::property {

/// A random but valid scenario, as its file: any key of docs/scenario.md within its bounds, up to three effects of the
/// catalogue with any parameters. Short courses, one run each way. The same seed is the same scenario for one compiler:
/// in which order the arguments of a call are drawn is the compiler's. `mirrored`: nothing in it tells left from right.
struct Drawn {
  std::string yaml;
  bool mirrored = false;
};
Drawn draw(std::uint64_t seed);

}  // namespace umbsim::property
