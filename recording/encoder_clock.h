#pragma once

#include <algorithm>
#include <vector>

#include "recording/recording.h"

namespace umbsim {

/// Finds where times lie between encoder samples. Times must not decrease from call to call.
class EncoderClock {
 public:
  /// The sample before a time, and the share of the way to the next one, 0 to 1. Times outside count as the nearest
  /// end.
  struct Moment {
    std::size_t before = 0;
    double share = 0;

    template <class T>
    T between(const T& a, const T& b) const { return a + (b - a) * share; }
  };

  /// `samples` (at least two) must outlive the clock.
  explicit EncoderClock(const std::vector<EncoderSample>& samples) : samples_(samples) {}

  Moment at(double time_s) {
    while (i_ + 2 < samples_.size() && samples_[i_ + 1].time_s < time_s) ++i_;
    const double from_s = samples_[i_].time_s;
    return {i_, std::clamp((time_s - from_s) / (samples_[i_ + 1].time_s - from_s), 0.0, 1.0)};
  }

 private:
  const std::vector<EncoderSample>& samples_;
  std::size_t i_ = 0;
};

}  // namespace umbsim
