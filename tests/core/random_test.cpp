#include "core/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace umbsim {
namespace {

constexpr int kSamples = 100000;
constexpr double kSigmas = 5;  // a wrong alarm in two million, and the seeds are fixed

TEST(RandomStream, SameKeySameNumbers) {
  RandomStream a(7, "encoder", 3), b(7, "encoder", 3);
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(a.bits(), b.bits());
    EXPECT_EQ(a.normal(), b.normal());
    EXPECT_EQ(a.uniform(), b.uniform());
  }
}

// Computed by a separate program from the published definitions of splitmix64, std::seed_seq and mt19937-64: every
// stored result depends on these bits.
TEST(RandomStream, PublishedGenerator) {
  RandomStream stream(1, "encoder", 2);
  EXPECT_EQ(stream.bits(), 17832914027564597044u);
  EXPECT_EQ(stream.bits(), 7208585461436140885u);
}

TEST(RandomStream, NeighbouringKeysDoNotMeet) {
  std::set<std::uint64_t> first_bits;
  std::size_t streams = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    for (const char* name : {"encoder.left", "encoder.lefs", "ncoder.eleft", "truth.noise1", "truth.noise2", ""}) {
      for (std::uint64_t index = 0; index < 50; ++index, ++streams) {
        first_bits.insert(RandomStream(seed, name, index).bits());
      }
    }
  }
  EXPECT_EQ(first_bits.size(), streams);
}

TEST(RandomStream, NeighbouringStreamsAreUncorrelated) {
  RandomStream a(1, "noise", 0), b(1, "noise", 1), c(2, "noise", 0);
  double ab = 0, ac = 0;
  for (int i = 0; i < kSamples; ++i) {
    const double x = a.normal();
    ab += x * b.normal();
    ac += x * c.normal();
  }
  // The product of two standard normals has variance 1.
  EXPECT_NEAR(ab / kSamples, 0, kSigmas / std::sqrt(kSamples));
  EXPECT_NEAR(ac / kSamples, 0, kSigmas / std::sqrt(kSamples));
}

TEST(RandomStream, NormalHasItsMoments) {
  constexpr double kMean = 3, kSd = 0.5;
  RandomStream stream(11, "normal");
  double sum = 0, squares = 0;
  for (int i = 0; i < kSamples; ++i) {
    const double deviation = stream.normal(kMean, kSd) - kMean;
    sum += deviation;
    squares += deviation * deviation;
  }
  EXPECT_NEAR(sum / kSamples, 0, kSigmas * kSd / std::sqrt(kSamples));
  // Var((x - mean)^2) = 2 sd^4.
  EXPECT_NEAR(squares / kSamples, kSd * kSd, kSigmas * std::sqrt(2.0) * kSd * kSd / std::sqrt(kSamples));
}

TEST(RandomStream, UniformFillsItsRangeEvenly) {
  constexpr int kBins = 10;
  constexpr double kMin = -2, kMax = 3;
  RandomStream stream(12, "uniform");
  std::vector<int> counts(kBins);
  for (int i = 0; i < kSamples; ++i) {
    const double value = stream.uniform(kMin, kMax);
    ASSERT_GE(value, kMin);
    ASSERT_LT(value, kMax);
    ++counts[std::size_t((value - kMin) / (kMax - kMin) * kBins)];
  }
  constexpr double kExpected = double(kSamples) / kBins;
  const double sd = std::sqrt(kExpected * (1 - 1.0 / kBins));  // binomial
  for (const int count : counts) EXPECT_NEAR(count, kExpected, kSigmas * sd);
}

TEST(RandomStream, ZeroSpreadIsTheMean) {
  RandomStream stream(13, "none");
  EXPECT_EQ(stream.normal(2.5, 0), 2.5);
  EXPECT_EQ(stream.uniform(2.5, 2.5), 2.5);
}

}  // namespace
}  // namespace umbsim
