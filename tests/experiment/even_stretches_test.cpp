// Where a replay may go in one time step, against closed forms.
#include "experiment/replay/even_stretches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace umbsim {
namespace {

constexpr double kSample_s = 0.01;
constexpr double kWheelbase_m = 0.4;

// Of wheels that have rolled so far (left, right; metres) at a time.
template <class Ways>
EvenStretches stretches_of(double duration_s, const Ways& ways_at) {
  std::vector<EncoderSample> samples(std::size_t(std::lround(duration_s / kSample_s)) + 1);
  std::array<std::vector<double>, 2> way_m;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples[i].time_s = double(i) * kSample_s;
    const std::array<double, 2> ways = ways_at(samples[i].time_s);
    for (std::size_t w = 0; w < 2; ++w) way_m[w].push_back(ways[w]);
  }
  return even_stretches(samples, way_m, {1, 1}, kWheelbase_m);
}

double longest_s(const EvenStretches& stretches) {
  std::size_t longest = stretches.front().end;
  for (std::size_t i = 1; i < stretches.size(); ++i)
    longest = std::max(longest, stretches[i].end - stretches[i - 1].end);
  return double(longest) * kSample_s;
}

TEST(EvenStretches, AreAFifthOfASecondStraightOnOrAtRest) {
  const auto going = stretches_of(4, [](double t) { return std::array{0.3 * t, 0.3 * t}; });
  const auto standing = stretches_of(4, [](double) { return std::array{0.0, 0.0}; });
  EXPECT_EQ(going.size(), 20u);
  EXPECT_EQ(going.back().end, 400u);
  EXPECT_EQ(standing.size(), going.size());
  EXPECT_NEAR(going.front().peak_mps2, 0.3 / kSample_s, 1e-9) << "from rest";
  EXPECT_NEAR(going.back().peak_mps2, 0, 1e-9);
}

TEST(EvenStretches, OfATurnAreATenthOfARadian) {
  const double radps = 1.25;
  const auto turning = [&](double t) {
    return std::array{-0.5 * kWheelbase_m * radps * t, 0.5 * kWheelbase_m * radps * t};
  };
  EXPECT_NEAR(longest_s(stretches_of(4, turning)), 0.1 / radps, 1e-9);
}

// A ramp is a t^2 / 8 from an even speed in the middle of a stretch.
TEST(EvenStretches, OfARampAreShorter) {
  const double mps2 = 0.25;
  const auto starting = [&](double t) { return std::array{0.5 * mps2 * t * t, 0.5 * mps2 * t * t}; };
  EXPECT_NEAR(longest_s(stretches_of(4, starting)), std::sqrt(8 * 5e-5 / (mps2 * std::sqrt(2))), kSample_s);
}

TEST(EvenStretches, EndWhereATurnBegins) {
  const auto ways = [](double t) { return std::array{0.3 * std::min(t, 1.13), 0.3 * t}; };
  const EvenStretches stretches = stretches_of(2, ways);
  EXPECT_TRUE(std::any_of(stretches.begin(), stretches.end(), [](const EvenStretch& s) { return s.end == 113; }));
}

}  // namespace
}  // namespace umbsim
