// The tracker's clock against the encoders', from headings alone.
#include "gap/noise/clock.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/gap/recordings.h"

namespace umbsim::gap {
namespace {

// Truth stamped by a clock that is `offset_s` behind and runs slow by `rate`.
Recording stamped(double offset_s, double rate) {
  Scenario s = testing::squares(1.5, 1);
  testing::add_noise(s, 11);
  s.truth.heading_sd_rad = 0.004;
  Recording r = run_experiment(s, 0).recording;
  for (RecordedRun& run : r.runs) {
    for (TruthSample& t : run.truth) t.time_s = (t.time_s - offset_s) / (1 + rate);
    while (run.truth.front().time_s < 0) run.truth.erase(run.truth.begin());
  }
  return r;
}

// Twice the standard deviations that the fit states for headings of 4 mrad.
constexpr double kOffset_s = 0.003;
constexpr double kRate = 1.4e-4;

TEST(Clock, OffsetAndRateAreFound) {
  const Recording r = stamped(0.12, -0.002);
  for (const RecordedRun& run : r.runs) {
    const ClockFit fit = fit_clock(run, r.robot);
    fmt::print("{}: offset {:.4f} +- {:.4f} s, rate {:.5f} +- {:.5f}\n", run.id, fit.offset_s, fit.offset_sd_s,
               fit.rate, fit.rate_sd);
    EXPECT_NEAR(fit.offset_s, 0.12, kOffset_s);
    EXPECT_NEAR(fit.rate, -0.002, kRate);
  }
}

TEST(Clock, AlignedTruthIsThatOfOneClock) {
  const Recording r = with_clocks_aligned(stamped(0.12, -0.002)).recording;
  for (const RecordedRun& run : r.runs) {
    const ClockFit left = fit_clock(run, r.robot);
    EXPECT_NEAR(left.offset_s, 0, kOffset_s);
    EXPECT_NEAR(left.rate, 0, kRate);
    EXPECT_LE(run.truth.back().time_s, run.encoders.back().time_s);
  }
}

TEST(Clock, WrongWheelbaseIsNoClock) {
  Recording r = stamped(0, 0);
  r.robot.wheelbase_m *= 1.01;
  for (const RecordedRun& run : r.runs) EXPECT_NEAR(fit_clock(run, r.robot).offset_s, 0, kOffset_s);
}

}  // namespace
}  // namespace umbsim::gap
