#include "calibration/intake/unwrap.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace umbsim::intake {
namespace {

constexpr std::int64_t kFewTicks = 20;  // a step so small is usual for any wheel
constexpr double kUsual = 3;            // times the steps that a wheel usually makes

using Ticks = std::int64_t EncoderSample::*;

// Near the largest step that is no wrap.
std::int64_t usual_step(const std::vector<EncoderSample>& s, Ticks ticks, std::int64_t range) {
  std::vector<std::int64_t> steps;
  for (std::size_t i = 1; i < s.size(); ++i) {
    const std::int64_t step = std::abs(s[i].*ticks - s[i - 1].*ticks);
    if (step <= range / 2) steps.push_back(step);
  }
  if (steps.empty()) return 0;
  const auto at = steps.begin() + std::ptrdiff_t(0.99 * double(steps.size() - 1));
  std::nth_element(steps.begin(), at, steps.end());
  return *at;
}

// How often this wheel's counter wrapped at `range`; 0 where it did not, or where something else is wrong with it.
int unwrap(std::vector<EncoderSample>& s, Ticks ticks, std::int64_t range) {
  const auto [least, most] = std::minmax_element(
      s.begin(), s.end(), [&](const EncoderSample& a, const EncoderSample& b) { return a.*ticks < b.*ticks; });
  if ((*most).*ticks - (*least).*ticks >= range) return 0;
  const std::int64_t allowed = std::int64_t(kUsual * double(usual_step(s, ticks, range))) + kFewTicks;
  std::vector<std::int64_t> unwrapped{s.front().*ticks};
  std::int64_t turns = 0;
  int wraps = 0;
  for (std::size_t i = 1; i < s.size(); ++i) {
    const std::int64_t step = s[i].*ticks - s[i - 1].*ticks;
    if (std::abs(step) > range / 2) {
      const std::int64_t way = step > 0 ? -1 : 1;
      if (std::abs(step + way * range) > allowed) return 0;
      turns += way;
      ++wraps;
    }
    unwrapped.push_back(s[i].*ticks + turns * range);
  }
  if (wraps == 0) return 0;
  for (std::size_t i = 0; i < s.size(); ++i) s[i].*ticks = unwrapped[i];
  return wraps;
}

}  // namespace

std::vector<std::string> unwrap_counters(Recording& recording) {
  std::vector<std::string> said;
  for (RecordedRun& run : recording.runs) {
    std::vector<std::string> parts;
    for (const auto& [ticks, name] :
         {std::pair{&EncoderSample::left_ticks, "left_ticks"}, std::pair{&EncoderSample::right_ticks, "right_ticks"}}) {
      for (const int bits : {16, 32}) {
        const int wraps = unwrap(run.encoders, ticks, std::int64_t(1) << bits);
        if (wraps == 0) continue;
        parts.push_back(fmt::format("{} at {} bits, {} time{}", name, bits, wraps, wraps == 1 ? "" : "s"));
        break;
      }
    }
    if (!parts.empty())
      said.push_back(fmt::format("run {}: the counters wrap and were unwrapped: {}", run.id, fmt::join(parts, "; ")));
  }
  return said;
}

}  // namespace umbsim::intake
