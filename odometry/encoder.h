#pragma once

#include <cmath>
#include <cstdint>
#include <deque>
#include <utility>

#include "core/random.h"

namespace umbsim {

/// What goes wrong with one encoder. All zero: nothing.
struct EncoderFaults {
  double missed_probability = 0;          ///< that a tick is not counted
  double missed_probability_per_radps = 0;  ///< grows with the wheel's speed by this

  bool operator==(const EncoderFaults&) const = default;
};

/// An incremental encoder on each drive wheel, read at a fixed rate.
struct EncoderSpec {
  double ticks_per_revolution = 2000;  ///< of the wheel; may be fractional (gear ratio); > 0
  double rate_hz = 50;                 ///< of reading, and of the control loop
  double sampling_interval_s = 0;      ///< the counters are latched this often; 0: at every reading
  double latency_s = 0;                ///< a reading is this old when it arrives
  EncoderFaults left;
  EncoderFaults right;

  bool operator==(const EncoderSpec&) const = default;
};

/// Mean age, s, of latched counts as they are read, a reading every `period_s`. The first reading after an interval
/// latches: from one latch to the next it takes whole periods, n or n + 1, of which the counts stand still all but one.
double mean_latch_age_s(double interval_s, double period_s);

/// Counts of a wheel that has turned by `angle_rad`. Rounds to the nearest tick, so that a robot and its mirror image
/// count alike.
inline std::int64_t ticks(const EncoderSpec& spec, double angle_rad) {
  return std::llround(angle_rad / (2 * M_PI) * spec.ticks_per_revolution);
}

/// One wheel's encoder with its faults. Deterministic for a given stream.
class Encoder {
 public:
  Encoder(const EncoderSpec& spec, const EncoderFaults& faults, RandomStream random)
      : spec_(spec), faults_(faults), random_(random) {}

  /// Reads at `time_s` (increasing) with the shaft at `angle_rad`; returns cumulative ticks as they arrive.
  std::int64_t read(double time_s, double angle_rad);

 private:
  std::int64_t counted(double time_s, double angle_rad);

  EncoderSpec spec_;
  EncoderFaults faults_;
  RandomStream random_;
  std::int64_t true_ticks_ = 0;
  std::int64_t count_ = 0;
  std::int64_t latched_ = 0;
  double last_s_ = 0;
  double next_latch_s_ = 0;
  std::deque<std::pair<double, std::int64_t>> on_the_way_;
};

}  // namespace umbsim
