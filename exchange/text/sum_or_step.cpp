#include "exchange/text/sum_or_step.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "core/error.h"
#include "exchange/import/wheels/counts.h"

namespace umbsim::exchange {
namespace {

constexpr std::size_t kRest = 8;     // equal samples in a row: the wheel stands still, or runs evenly
constexpr double kUsual = 0.99;      // of the steps are as large at most; beyond are jumps of a counter
constexpr double kFar = 20;          // usual steps that a sum's rests lie apart, at least
constexpr double kOwnRests = 0.3;    // share of a sum's rests that come once; speeds are the same few again and again
constexpr double kMonotone = 0.5;    // of the whole way up and down, that the range of a sum without rests is
constexpr double kUpAndDown = 0.15;  // the same of what samples add, at most

/// What a column does.
struct SignalStatistics {
  std::size_t rests = 0;
  std::set<double> rest_values;
  double usual_step = 0, range = 0, way = 0;
};

SignalStatistics statistics_of(const std::vector<double>& values) {
  SignalStatistics h;
  std::vector<double> steps;
  std::size_t equal = 1;
  for (std::size_t i = 1; i < values.size(); ++i) {
    steps.push_back(std::abs(values[i] - values[i - 1]));
    h.way += steps.back();
    equal = values[i] == values[i - 1] ? equal + 1 : 1;
    if (equal != kRest) continue;
    ++h.rests;
    h.rest_values.insert(values[i]);
  }
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  h.range = *high - *low;
  const auto usual = steps.begin() + std::ptrdiff_t(kUsual * double(steps.size() - 1));
  std::nth_element(steps.begin(), usual, steps.end());
  h.usual_step = *usual;
  return h;
}

bool is_sum(const SignalStatistics& h) {
  if (h.rest_values.size() < 2) return h.range > kMonotone * h.way && h.range > kFar * h.usual_step;
  const double apart = *h.rest_values.rbegin() - *h.rest_values.begin();
  return apart > kFar * h.usual_step && double(h.rest_values.size()) > kOwnRests * double(h.rests);
}

bool is_steps(const SignalStatistics& h) {
  const bool rests_at_zero = h.rest_values.empty() || h.rest_values.count(0) > 0;
  return rests_at_zero && h.range < kUpAndDown * h.way;
}

}  // namespace

bool is_per_sample(const WheelSignal& signal, bool name_says_so, const std::string& said, const std::string& file) {
  if (!said.empty()) return said == "per-sample";
  if (name_says_so) return true;
  const SignalStatistics statistics = statistics_of(unwrapped(signal).value);
  if (statistics.range == 0) return false;  // a wheel that stands still is one by any reading; the checks will name it
  if (is_sum(statistics)) return false;
  if (is_steps(statistics)) return true;
  throw InputError(fmt::format(
      "{}: whether column '{}' holds the sum or what each sample added cannot be told: give --counts cumulative or "
      "--counts per-sample",
      file, signal.name));
}

}  // namespace umbsim::exchange
