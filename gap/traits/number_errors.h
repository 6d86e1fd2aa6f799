#pragma once

#include <string>

namespace umbsim::gap {

/// By how much a size that is found is off where this simulator did not make the recording: standard deviations beyond
/// what its noise leaves open. `umbsim_worlds numbers` learns them (docs/worlds.md).
struct NumberError {
  double log = 0;     ///< of the logarithm of a size
  double time_s = 0;  ///< of a time: what servos and readings lag by adds to it
};

/// Of the sizes of an effect; of a name that is no effect's: as little as here.
NumberError number_error_of(const std::string& effect);

/// The same of where, in which direction and when an effect acts, of all effects alike: by hand, near what was found.
constexpr double kPlaceElsewhere_m = 0.05;
constexpr double kAngleElsewhere_rad = 0.05;
constexpr double kMomentElsewhere_s = 0.03;

}  // namespace umbsim::gap
