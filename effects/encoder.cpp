#include "effects/encoder.h"

namespace umbsim {

void apply(const EncoderResolution& effect, Rig& rig) {
  if (effect.ticks_per_revolution > 0) rig.encoders.ticks_per_revolution = effect.ticks_per_revolution;
}

void apply(const EncoderSampling& effect, Rig& rig) { rig.encoders.sampling_interval_s = effect.interval_s; }

void apply(const EncoderMissedCounts& effect, Rig& rig) {
  rig.encoders.left = {effect.left_probability, effect.probability_per_radps};
  rig.encoders.right = {effect.right_probability, effect.probability_per_radps};
}

void apply(const EncoderLatency& effect, Rig& rig) { rig.encoders.latency_s = effect.seconds; }

}  // namespace umbsim
