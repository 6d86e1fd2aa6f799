#include "exchange/import/wheels/wheel_commands.h"

#include <fmt/format.h>

#include <algorithm>

namespace umbsim::exchange {
namespace {

Nanoseconds timeout_of(const std::vector<Nanoseconds>& at) {
  constexpr Nanoseconds kShortest_ns = 500'000'000;
  constexpr Nanoseconds kIntervals = 3;
  std::vector<Nanoseconds> steps;
  for (std::size_t i = 1; i < at.size(); ++i) steps.push_back(at[i] - at[i - 1]);
  if (steps.empty()) return kShortest_ns;
  const auto middle = steps.begin() + std::ptrdiff_t(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return std::max(kShortest_ns, kIntervals * *middle);
}

}  // namespace

std::pair<WheelSignal, WheelSignal> wheel_commands(const BodyCommands& c, double wheelbase_m,
                                                   std::vector<std::string>& found) {
  const Nanoseconds timeout = timeout_of(c.at);
  WheelSignal left{c.name, WheelUnit::mps, false, {}, {}}, right = left;
  const auto add = [&](Nanoseconds at, double linear_mps, double angular_radps) {
    left.at.push_back(at);
    right.at.push_back(at);
    left.value.push_back(linear_mps - angular_radps * wheelbase_m / 2);
    right.value.push_back(linear_mps + angular_radps * wheelbase_m / 2);
  };
  std::size_t ended = 0;
  for (std::size_t i = 0; i < c.at.size(); ++i) {
    add(c.at[i], c.linear_mps[i], c.angular_radps[i]);
    if (i + 1 < c.at.size() && c.at[i + 1] - c.at[i] <= timeout) continue;
    if (c.linear_mps[i] != 0 || c.angular_radps[i] != 0) ++ended;
    add(c.at[i] + timeout, 0, 0);
  }
  if (ended > 0) {
    found.push_back(fmt::format("commands: {} that none followed within {:g} s: taken as ended then", ended,
                                double(timeout) * 1e-9));
  }
  return {std::move(left), std::move(right)};
}

}  // namespace umbsim::exchange
