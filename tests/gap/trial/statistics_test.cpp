#include "gap/trial/score/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "core/random.h"

namespace umbsim::trial_testing {
namespace {

constexpr double kExact = 1e-9;
constexpr double kPrinted = 5e-5;  // tables give four decimals

// With no hit, the upper Clopper-Pearson bound p solves (1 - p)^n = tail.
TEST(Share, WithoutHitsTheBoundIsInClosedForm) {
  for (const int n : {1, 20, 60}) {
    EXPECT_EQ(share(0, n).low, 0);
    EXPECT_NEAR(share(0, n).high, 1 - std::pow(0.025, 1.0 / n), kExact);
    EXPECT_NEAR(upper_bound(0, n), 1 - std::pow(0.05, 1.0 / n), kExact);
    EXPECT_NEAR(share(n, n).low, std::pow(0.025, 1.0 / n), kExact);
    EXPECT_EQ(share(n, n).high, 1);
  }
}

// Clopper & Pearson 1934, as tabulated: 8 of 10.
TEST(Share, AgreesWithTheTable) {
  EXPECT_NEAR(share(8, 10).low, 0.4439, kPrinted);
  EXPECT_NEAR(share(8, 10).high, 0.9748, kPrinted);
}

TEST(Share, SixtyCasesWithoutAFalseAlarmMeetTheBarAndOneDoesNot) {
  EXPECT_LE(upper_bound(0, 60), 0.05);
  EXPECT_GT(upper_bound(1, 60), 0.05);
}

TEST(Share, OfNothingIsUnknown) {
  EXPECT_EQ(share(0, 0).low, 0);
  EXPECT_EQ(share(0, 0).high, 1);
  EXPECT_EQ(upper_bound(0, 0), 1);
}

TEST(Median, OfOddAndEvenNumbers) {
  EXPECT_EQ(middle({3, 1, 2}), 2);
  EXPECT_EQ(middle({4, 1, 3, 2}), 2.5);
  EXPECT_THROW(middle({}), std::invalid_argument);
}

// The bootstrap interval holds the true median in about 95 % of samples.
TEST(Median, ItsIntervalCoversTheTrueMedian) {
  constexpr int kSamples = 200;
  int covered = 0;
  for (int i = 0; i < kSamples; ++i) {
    RandomStream random(1, "sample", std::uint64_t(i));
    std::vector<double> values(41);
    for (double& v : values) v = random.normal(5, 2);
    const Estimate m = median(values);
    EXPECT_LE(m.low, m.value);
    EXPECT_GE(m.high, m.value);
    covered += m.low <= 5 && 5 <= m.high;
  }
  // Binomial with p = 0.95, four standard deviations; percentile intervals of medians err by a few per cent.
  EXPECT_NEAR(double(covered) / kSamples, 0.95, 4 * std::sqrt(0.95 * 0.05 / kSamples));
}

}  // namespace
}  // namespace umbsim::trial_testing
