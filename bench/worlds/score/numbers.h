#pragma once

#include <string>
#include <vector>

#include "bench/worlds/score/score.h"

namespace umbsim::worlds {

/// What a number says, and so in what it is off.
enum class Measure {
  size,   ///< how strong an effect is: by a logarithm
  time,   ///< the same in seconds: by seconds
  place,  ///< where it acts: by metres along an axis
  angle,  ///< in which direction: by radians
};

/// A number of an effect that was named rightly.
struct FoundNumber {
  std::string effect;
  std::string engine;
  Measure measure = Measure::size;
  double off = 0;       ///< found less true, in its measure
  double noise_sd = 0;  ///< of that, by what the interval holds besides gap/traits/number_errors.h
};

/// Of single effects that show. Left out are sizes that were not found, or with the other sign, and where a cable lies:
/// a line has no one place.
std::vector<FoundNumber> found_numbers(const WorldScore& score);

/// The error that intervals hold of a recording that this simulator did not make, standard deviation.
double error_in_use(const std::string& effect, Measure measure);

/// The one that makes these numbers likeliest, on a grid. Before any are seen it is thought to be 0.1 of a size, 5 ms,
/// 2 cm and 0.02 rad, each within a factor of three: where they say nothing it is that.
double likeliest_error(const std::vector<FoundNumber>& numbers, Measure measure);

/// How many lie within 95 % intervals that hold such an error.
int held(const std::vector<FoundNumber>& numbers, double error);

}  // namespace umbsim::worlds
