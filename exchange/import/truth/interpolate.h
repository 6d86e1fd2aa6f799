#pragma once

#include <algorithm>
#include <vector>

#include "exchange/import/log.h"

namespace umbsim::exchange {

/// A number between its samples, straight; times must not decrease from call to call. Outside: the nearest end.
class Interpolator {
 public:
  Interpolator(const std::vector<Nanoseconds>& at, const std::vector<double>& value) : at_(at), value_(value) {}

  double at(Nanoseconds t) {
    while (i_ + 2 < at_.size() && at_[i_ + 1] < t) ++i_;
    if (at_.size() < 2) return value_.front();
    const double share = std::clamp(double(t - at_[i_]) / double(at_[i_ + 1] - at_[i_]), 0.0, 1.0);
    return value_[i_] + share * (value_[i_ + 1] - value_[i_]);
  }

 private:
  const std::vector<Nanoseconds>& at_;
  const std::vector<double>& value_;
  std::size_t i_ = 0;
};

/// A command, which holds until the next one; 0 before the first. Times must not decrease from call to call.
class Held {
 public:
  Held(const std::vector<Nanoseconds>& at, const std::vector<double>& value) : at_(at), value_(value) {}

  double at(Nanoseconds t) {
    while (i_ < at_.size() && at_[i_] <= t) ++i_;
    return i_ == 0 ? 0 : value_[i_ - 1];
  }

 private:
  const std::vector<Nanoseconds>& at_;
  const std::vector<double>& value_;
  std::size_t i_ = 0;
};

}  // namespace umbsim::exchange
