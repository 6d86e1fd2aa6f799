#pragma once

#include "effects/rig.h"

namespace umbsim {

/// Ticks per wheel revolution that the encoders really have; the odometry knows.
struct EncoderResolution {
  double ticks_per_revolution = 0;  ///< 0: the scenario's
};
void apply(const EncoderResolution& effect, Rig& rig);

/// The counters are latched only this often.
struct EncoderSampling {
  double interval_s = 0;
};
void apply(const EncoderSampling& effect, Rig& rig);

/// Ticks get lost.
struct EncoderMissedCounts {
  double left_probability = 0;
  double right_probability = 0;
  double probability_per_radps = 0;  ///< both wheels, times the wheel's speed
};
void apply(const EncoderMissedCounts& effect, Rig& rig);

/// Readings arrive late.
struct EncoderLatency {
  double seconds = 0;
};
void apply(const EncoderLatency& effect, Rig& rig);

}  // namespace umbsim
