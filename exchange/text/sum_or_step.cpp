#include "exchange/text/sum_or_step.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace umbsim::exchange {
namespace {

// A sum goes far in many small steps; what each sample adds goes up and down about the same few values.
constexpr double kFar = 0.2;         // of the whole way up and down, that a sum's range is at least
constexpr double kSmallStep = 0.01;  // of the range, that a sum's largest step is at most
constexpr double kNear = 0.15;
constexpr double kLargeStep = 1.0 / 60;

}  // namespace

bool is_per_sample(const WheelSignal& signal, bool name_says_so, const std::string& said, const std::string& file) {
  if (!said.empty()) return said == "per-sample";
  if (name_says_so) return true;
  const auto [low, high] = std::minmax_element(signal.value.begin(), signal.value.end());
  const double range = *high - *low;
  double way = 0, largest = 0;
  for (std::size_t i = 1; i < signal.value.size(); ++i) {
    const double step = std::abs(signal.value[i] - signal.value[i - 1]);
    way += step;
    largest = std::max(largest, step);
  }
  if (range == 0) return false;  // a wheel that stands still is one by any reading; the checks will name it
  if (range > kFar * way && largest < kSmallStep * range) return false;
  if (range < kNear * way && largest > kLargeStep * range) return true;
  throw InputError(fmt::format(
      "{}: whether column '{}' holds the sum or what each sample added cannot be told: give --counts cumulative or "
      "--counts per-sample",
      file, signal.name));
}

}  // namespace umbsim::exchange
