#pragma once

#include <cmath>
#include <cstdint>

namespace umbsim {

/// An incremental encoder on each drive wheel, read at a fixed rate.
struct EncoderSpec {
  double ticks_per_revolution = 2000;  ///< of the wheel; may be fractional (gear ratio); > 0
  double rate_hz = 50;                 ///< of reading, and of the control loop
};

/// Counts of a wheel that has turned by `angle_rad`. Rounds to the nearest tick, so that a robot and its mirror image
/// count alike.
inline std::int64_t ticks(const EncoderSpec& spec, double angle_rad) {
  return std::llround(angle_rad / (2 * M_PI) * spec.ticks_per_revolution);
}

}  // namespace umbsim
