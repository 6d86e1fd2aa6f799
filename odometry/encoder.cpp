#include "odometry/encoder.h"

#include <cmath>

namespace umbsim {
namespace {
constexpr double kClockSlack_s = 1e-9;  // times are sums of periods
}

double mean_latch_age_s(double interval_s, double period_s) {
  if (interval_s <= period_s) return 0;
  const double periods = interval_s / period_s;  // in the mean: n or n + 1, with ages of 0 to n - 1 or n
  const double n = std::floor(periods);
  return period_s * n * (n - 1 + 2 * (periods - n)) / (2 * periods);
}

// Every tick that passes is missed with its probability, forwards and backwards alike.
std::int64_t Encoder::counted(double time_s, double angle_rad) {
  const std::int64_t now = ticks(spec_, angle_rad);
  std::int64_t passed = now - true_ticks_;
  true_ticks_ = now;
  const double elapsed_s = time_s - last_s_;
  last_s_ = time_s;
  double probability = faults_.missed_probability;
  if (elapsed_s > 0 && faults_.missed_probability_per_radps > 0) {
    const double speed_radps = std::abs(double(passed)) * 2 * M_PI / spec_.ticks_per_revolution / elapsed_s;
    probability += faults_.missed_probability_per_radps * speed_radps;
  }
  if (probability > 0) {
    const std::int64_t step = passed < 0 ? -1 : 1;
    for (std::int64_t i = std::abs(passed); i > 0; --i) passed -= random_.uniform() < probability ? step : 0;
  }
  return count_ += passed;
}

std::int64_t Encoder::read(double time_s, double angle_rad) {
  const std::int64_t count = counted(time_s, angle_rad);
  if (time_s + kClockSlack_s >= next_latch_s_) {
    latched_ = count;
    next_latch_s_ = spec_.sampling_interval_s > 0 ? next_latch_s_ + spec_.sampling_interval_s : time_s;
  }
  if (spec_.latency_s <= 0) return latched_;
  on_the_way_.emplace_back(time_s, latched_);
  // The newest reading that is old enough; before the first arrives, the wheel stands at zero.
  std::int64_t arrived = on_the_way_.front().first <= time_s - spec_.latency_s + kClockSlack_s
                             ? on_the_way_.front().second
                             : 0;
  while (on_the_way_.size() > 1 && on_the_way_[1].first <= time_s - spec_.latency_s + kClockSlack_s) {
    on_the_way_.pop_front();
    arrived = on_the_way_.front().second;
  }
  return arrived;
}

}  // namespace umbsim
