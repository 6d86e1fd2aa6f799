#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/worlds/run/fault.h"

namespace umbsim::worlds {

/// One effect in one engine beside the same effect in this simulator.
struct Compared {
  std::string engine;
  double ratio = 0;   ///< of its signature, projected on this simulator's
  double alike = 0;   ///< cosine between both signatures; the signal's noise gives the scale of x, y and heading
  std::string error;  ///< why the engine could not drive it
};

struct ComparedEffect {
  std::string effect;
  Signal signal = Signal::odometry;  ///< in which this simulator shows it more
  double severity = 0;               ///< noise floors here
  Json numbers;
  std::vector<Compared> engines;  ///< of those that express it, but for this simulator
};

/// A world for comparisons: a LabMate of the proving ground on plain squares, driven by umbmark's driver on odometry,
/// with tyres that creep a little, in the middle of the engine's options.
World plain_world(const std::string& engine);

/// The effect at about `wanted` noise floors in every engine that expresses it.
ComparedEffect compare(const std::string& effect, double wanted, std::uint64_t seed);

}  // namespace umbsim::worlds
