#include "exchange/import/wheels/counts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace umbsim::exchange {
namespace {

// Revolutions (or revolutions per second) of one unit; ticks stay.
double scale(WheelUnit unit, double radius_m) {
  const double around_m = 2 * M_PI * radius_m;
  switch (unit) {
    case WheelUnit::ticks:
    case WheelUnit::rev:
      return 1;
    case WheelUnit::rad:
    case WheelUnit::radps:
      return 1 / (2 * M_PI);
    case WheelUnit::deg:
    case WheelUnit::degps:
      return 1.0 / 360;
    case WheelUnit::rpm:
      return 1.0 / 60;
    case WheelUnit::m:
    case WheelUnit::mps:
      return 1 / around_m;
    case WheelUnit::mm:
    case WheelUnit::mmps:
      return 0.001 / around_m;
    case WheelUnit::cm:
      return 0.01 / around_m;
  }
  return 1;
}

}  // namespace

Unwrapped unwrapped(const WheelSignal& s) {
  constexpr double kJump = 0.75;  // of a turn
  Unwrapped all{s.value, 0};
  if (s.value.empty() || (s.unit != WheelUnit::rad && s.unit != WheelUnit::deg && s.unit != WheelUnit::rev)) return all;
  const double turn = 1 / scale(s.unit, 1);
  const auto [low, high] = std::minmax_element(s.value.begin(), s.value.end());
  if (*high - *low > (1 + 1e-6) * turn) return all;
  double add = 0;
  for (std::size_t i = 1; i < all.value.size(); ++i) {
    const double step = (s.value[i] - s.value[i - 1]) / turn;
    if (std::abs(step) > kJump) {
      add -= std::copysign(turn, step);
      ++all.jumps;
    }
    all.value[i] += add;
  }
  return all;
}

std::vector<double> turned(const WheelSignal& s, double wheel_radius_m, std::vector<std::string>& found) {
  const double k = scale(s.unit, wheel_radius_m);
  std::vector<double> sum(s.value.size(), 0);
  if (is_rate(s.unit)) {
    for (std::size_t i = 1; i < sum.size(); ++i) {
      sum[i] = sum[i - 1] + k * (s.value[i] + s.value[i - 1]) / 2 * (double(s.at[i] - s.at[i - 1]) * 1e-9);
    }
    return sum;
  }
  if (s.per_sample) {
    for (std::size_t i = 1; i < sum.size(); ++i) sum[i] = sum[i - 1] + k * s.value[i];
    return sum;
  }
  const Unwrapped angles = unwrapped(s);
  if (angles.jumps > 0)
    found.push_back(fmt::format("{}: angles within one turn, {} jumps unwrapped", s.name, angles.jumps));
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = k * angles.value[i] - k * angles.value.front();
  return sum;
}

double resolution(const std::vector<double>& revolutions) {
  constexpr double kNothing = 2e-8;  // of a revolution: noise of printed numbers
  constexpr double kOff = 0.15;      // of a step, by which a position may miss a whole number of them
  double step = 1;
  for (std::size_t i = 1; i < revolutions.size(); ++i) {
    const double d = std::abs(revolutions[i] - revolutions[i - 1]);
    if (d > kNothing) step = std::min(step, d);
  }
  if (step < 1 / kFineCounts || step > 0.2) return 0;
  // Positions are whole steps from the first; the farther one lies, the better it says how long a step is.
  double far = 0;
  for (const double r : revolutions) {
    if (std::abs(r) > 1.2 * std::max(far, step)) {
      const double n = std::round(std::abs(r) / step);
      if (std::abs(std::abs(r) / step - n) > kOff * 2) return 0;
      step = std::abs(r) / n;
      far = std::abs(r);
    }
  }
  std::size_t off = 0;
  for (const double r : revolutions) off += std::abs(r / step - std::round(r / step)) > kOff ? 1 : 0;
  if (off > revolutions.size() / 1000) return 0;
  const double counts = 1 / step;
  const double whole = std::round(counts);
  return std::abs(counts - whole) < 1e-4 * counts ? whole : counts;
}

}  // namespace umbsim::exchange
