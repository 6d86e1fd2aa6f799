// Encoders and what goes wrong with them, against what a reader of their counts would reckon by hand.
#include "odometry/encoder.h"

#include <gtest/gtest.h>

#include <vector>

namespace umbsim {
namespace {

constexpr double kPeriod_s = 0.02;

EncoderSpec thousand_ticks() {
  EncoderSpec spec;
  spec.ticks_per_revolution = 1000;
  return spec;
}

// Counts at every reading of a wheel that turns by `ticks_per_reading`.
std::vector<std::int64_t> read_all(const EncoderSpec& spec, const EncoderFaults& faults, double ticks_per_reading,
                                   int readings, double period_s = kPeriod_s) {
  Encoder encoder(spec, faults, RandomStream(3, "encoder"));
  std::vector<std::int64_t> counts;
  for (int k = 0; k < readings; ++k)
    counts.push_back(encoder.read(k * period_s, 2 * M_PI * k * ticks_per_reading / spec.ticks_per_revolution));
  return counts;
}

TEST(Ticks, RoundToTheNearestAndMirror) {
  const EncoderSpec spec = thousand_ticks();
  const double tick_rad = 2 * M_PI / 1000;
  EXPECT_EQ(ticks(spec, 0.4 * tick_rad), 0);
  EXPECT_EQ(ticks(spec, 0.6 * tick_rad), 1);
  EXPECT_EQ(ticks(spec, -0.6 * tick_rad), -1);
  EXPECT_EQ(ticks(spec, 12345 * tick_rad), 12345);
}

TEST(Encoder, CountsWhatTheWheelTurns) {
  for (const double by : {7.0, -3.0}) {
    const auto counts = read_all(thousand_ticks(), {}, by, 100);
    for (int k = 0; k < 100; ++k) EXPECT_EQ(counts[std::size_t(k)], std::int64_t(by) * k);
  }
}

// Counts are late by whole readings; before the first of them arrives the wheel stands at zero.
TEST(Encoder, LatencyDelaysEveryReading) {
  EncoderSpec spec = thousand_ticks();
  spec.latency_s = 3 * kPeriod_s;
  const auto counts = read_all(spec, {}, 5, 50);
  for (int k = 0; k < 50; ++k) EXPECT_EQ(counts[std::size_t(k)], k < 3 ? 0 : 5 * (k - 3)) << k;
}

TEST(Encoder, LatencyBetweenReadingsIsThatOfTheOlderOne) {
  EncoderSpec spec = thousand_ticks();
  spec.latency_s = 2.5 * kPeriod_s;
  const auto counts = read_all(spec, {}, 5, 50);
  for (int k = 0; k < 50; ++k) EXPECT_EQ(counts[std::size_t(k)], k < 3 ? 0 : 5 * (k - 3)) << k;
}

// A counter that is latched every fourth reading stands still in between.
TEST(Encoder, LatchedCountsStandStill) {
  EncoderSpec spec = thousand_ticks();
  spec.sampling_interval_s = 4 * kPeriod_s;
  const auto counts = read_all(spec, {}, 5, 50);
  for (int k = 0; k < 50; ++k) EXPECT_EQ(counts[std::size_t(k)], 5 * (k / 4 * 4)) << k;
}

// The age of latched counts as it is reckoned, against that of a long drive.
TEST(Encoder, LatchedCountsAreOldByTheirMeanAge) {
  constexpr int kReadings = 20000;
  EXPECT_EQ(mean_latch_age_s(kPeriod_s, kPeriod_s), 0);
  EXPECT_EQ(mean_latch_age_s(0, kPeriod_s), 0);
  EXPECT_NEAR(mean_latch_age_s(2 * kPeriod_s, kPeriod_s), kPeriod_s / 2, 1e-15);
  for (const double periods : {1.3, 2.0, 2.5, 3.75, 7.1}) {
    EncoderSpec spec = thousand_ticks();
    spec.sampling_interval_s = periods * kPeriod_s;
    const auto counts = read_all(spec, {}, 1, kReadings);
    double age_s = 0;
    for (int k = 0; k < kReadings; ++k) age_s += kPeriod_s * double(k - counts[std::size_t(k)]) / kReadings;
    EXPECT_NEAR(age_s, mean_latch_age_s(spec.sampling_interval_s, kPeriod_s), 1e-3 * kPeriod_s) << periods;
  }
}

// Every tick is lost by itself, forwards and backwards: binomial.
TEST(Encoder, LosesTicksWithTheirProbability) {
  constexpr int kReadings = 5001, kTicks = 20;
  for (const double probability : {0.01, 0.3, 1.0}) {
    for (const int by : {kTicks, -kTicks}) {
      EncoderFaults faults;
      faults.missed_probability = probability;
      const double passed = kTicks * (kReadings - 1.0);
      const auto counts = read_all(thousand_ticks(), faults, by, kReadings);
      const double lost = passed - std::abs(double(counts.back()));
      EXPECT_NEAR(lost, probability * passed, 4 * std::sqrt(probability * (1 - probability) * passed)) << by;
    }
  }
}

TEST(Encoder, LosesMoreTicksTheFasterItTurns) {
  constexpr int kReadings = 5001, kTicks = 20;
  EncoderFaults faults;
  faults.missed_probability = 0.02;
  faults.missed_probability_per_radps = 0.01;
  for (const double period_s : {0.02, 0.1}) {
    const double passed = kTicks * (kReadings - 1.0);
    const double speed_radps = 2 * M_PI * kTicks / 1000 / period_s;
    const double probability = 0.02 + 0.01 * speed_radps;
    const auto counts = read_all(thousand_ticks(), faults, -kTicks, kReadings, period_s);
    EXPECT_NEAR(passed + double(counts.back()), probability * passed,
                4 * std::sqrt(probability * (1 - probability) * passed))
        << period_s;
  }
}

TEST(Encoder, LosesTheSameTicksOfTheSameStream) {
  EncoderFaults faults;
  faults.missed_probability = 0.1;
  EXPECT_EQ(read_all(thousand_ticks(), faults, 9, 500), read_all(thousand_ticks(), faults, 9, 500));
}

}  // namespace
}  // namespace umbsim
