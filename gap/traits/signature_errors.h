#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <string>

namespace umbsim::gap {

/// What a robot does from one sample to the next.
enum CoursePart : std::size_t {
  kSpeeding,  ///< a wheel gets faster or slower
  kLeg,       ///< rolls on
  kInPlace,   ///< turns about the axle's middle
  kArc,       ///< turns while it rolls on
  kCourseParts
};

/// By how much the same effect may do something else in another engine, or on other tyres: standard deviations, as
/// shares of what it does here; of a commanded motion, of the motion itself.
struct SignatureErrors {
  std::array<double, kCourseParts> parts{};  ///< of all that it does in a part of the course, in runs of one condition
  double motion = 0;  ///< of what it does to one motion, from sample to sample: when and how it jerks, slips, lets go
  double counts = 0;  ///< of what counts against commands show of it
  double beside = 0;  ///< of the parts' shares: of turns that what it does along and across may come with, a wheel by
                      ///< itself, and of way along that what it does across may
};

/// Of effects whose signature follows from rolling alone, and of a name that is no effect's: hundredths.
SignatureErrors signature_errors_of(const std::string& effect);

/// Where they are taken from.
using ErrorsOf = std::function<SignatureErrors(const std::string& effect)>;

}  // namespace umbsim::gap
