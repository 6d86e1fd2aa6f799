#include "gap/trial/draw/severity.h"

#include "core/error.h"
#include "tests/gap/trial/fake_simulator.h"

namespace umbsim::trial_testing {
namespace {

constexpr double kNear = 0.1;  // severities are found to this; severity.cpp

struct Bench {
  TrialPlan plan = small_plan();
  Platform platform = draw_platform(plan, 0);
  TrialSimulator simulator = fake_simulator;
  Recording planned = planned_recording(plan, platform, plan.runs);
  SeverityScale scale{plan, platform, planned, simulator};

  DrawnEffect draw(const char* name) const {
    RandomStream random(1, "test");
    return draw_effect(find_effect(name), platform, plan.runs, random);
  }
  ScaledEffect scaled(const DrawnEffect& drawn, double severity, double level = 1) const {
    RandomStream random(2, "test");
    return scale_effect(drawn, severity, plan.severity, level, scale, random);
  }
};

TEST(Severity, IsZeroForANeutralEffectAndGrowsInProportionInALinearWorld) {
  const Bench bench;
  EXPECT_EQ(bench.scale.severity(neutral_effect(find_effect("wheelbase")), Signal::odometry), 0);
  const DrawnEffect drawn = bench.draw("wheelbase");
  const double one = bench.scale.severity(drawn.at(0.001), Signal::odometry);
  EXPECT_GT(one, 0);
  EXPECT_NEAR(bench.scale.severity(drawn.at(0.002), Signal::odometry), 2 * one, 1e-9 * one);
}

// In the fake world an effect of strength k turns the heading by k mrad/s and moves nothing else.
TEST(Severity, IsTheRootMeanSquareOfTheChangeOverThatOfTheNoise) {
  const Bench bench;
  const int intervals = int(50 * bench.platform.side_m) / 5;  // of absolute poses, 0.1 s each
  double square = 0;
  for (int k = 1; k <= 120; ++k) {
    const double heading_rad = 1e-3 * 0.1 * (intervals * k / 120);  // of a wheelbase off by 0.001
    square += heading_rad * heading_rad / 120;
  }
  // One of three components changes.
  const double expected = std::sqrt(square / 3) / bench.scale.noise(Signal::odometry).whole[2];
  EXPECT_NEAR(bench.scale.severity(bench.draw("wheelbase").at(0.001), Signal::odometry) / expected, 1, 1e-9);
}

TEST(Severity, TheNoiseFloorIsTheNoiseThatThePlanAsksFor) {
  const Bench bench;
  const SignalSize noise = bench.scale.noise(Signal::odometry);
  // Start and present pose are both measured.
  EXPECT_NEAR(noise.whole[1] / (std::sqrt(2.0) * bench.plan.noise.position_sd_m), 1, 0.3);
  EXPECT_GT(noise.whole[2], bench.plan.noise.heading_sd_rad);
}

TEST(Severity, AmplitudesAreFoundForWhatIsDrawn) {
  const Bench bench;
  for (const double severity : {0.5, 2.0, 9.0}) {
    const ScaledEffect scaled = bench.scaled(bench.draw("wheelbase"), severity);
    EXPECT_NEAR(std::log(scaled.severity / severity), 0, kNear);
    EXPECT_EQ(bench.scale.severity(scaled.effect, Signal::odometry), scaled.severity) << "the answers hold what it has";
    EXPECT_FALSE(scaled.undetectable);
  }
}

TEST(Severity, ANoisierRecordingNeedsAStrongerEffect) {
  const Bench bench;
  const ScaledEffect quiet = bench.scaled(bench.draw("wheelbase"), 2, 1),
                     noisy = bench.scaled(bench.draw("wheelbase"), 2, 3);
  EXPECT_NEAR(strength({noisy.effect}) / strength({quiet.effect}), 3, 3 * 2 * kNear);
}

TEST(Severity, AnEffectThatDoesNothingIsDrawnPlausiblyAndCountsAsUndetectable) {
  Bench bench;
  bench.simulator = [](const TrialDrive& drive) {
    TrialDrive without = drive;
    without.effects.clear();
    return fake_simulator(without);
  };
  const DrawnEffect drawn = bench.draw("wheelbase");
  const ScaledEffect scaled = bench.scaled(drawn, 3);
  EXPECT_TRUE(scaled.undetectable);
  EXPECT_EQ(scaled.severity, 0);
  EXPECT_GE(strength({scaled.effect}), 1000 * drawn.plausible.min);
  EXPECT_LE(strength({scaled.effect}), 1000 * drawn.plausible.max);
}

TEST(Severity, WhereThePlausibleMaximumIsWeakTheRangeBelowItIsUsed) {
  Bench bench;
  const DrawnEffect drawn = bench.draw("wheelbase");
  const double at_most = bench.scale.severity(drawn.at(drawn.range.max), Signal::odometry);
  bench.simulator = [at_most](const TrialDrive& drive) {
    TrialDrive weak = drive;
    for (Effect& e : weak.effects) e.values.numbers.front() *= 4 / at_most;  // severity 4 at the plausible maximum
    return fake_simulator(weak);
  };
  EXPECT_NEAR(std::log(bench.scaled(drawn, 10).severity / 4), 0, kNear);
  EXPECT_NEAR(std::log(bench.scaled(drawn, 0.5).severity / 0.5), 0, kNear);
  // Half-way up the drawn range is half-way up the range there is, both logarithmic.
  EXPECT_NEAR(std::log(bench.scaled(drawn, std::sqrt(0.5 * 10)).severity / std::sqrt(0.5 * 4)), 0, kNear);
}

TEST(Severity, WhatCannotBeDrivenCountsAsFarTooStrong) {
  Bench bench;
  const DrawnEffect drawn = bench.draw("wheelbase");
  const double limit = strength({drawn.at(drawn.range.max)}) / 2;
  bench.simulator = [limit](const TrialDrive& drive) {
    if (strength(drive.effects) > limit) throw RunError("the robot fell over");
    return fake_simulator(drive);
  };
  const ScaledEffect scaled = bench.scaled(drawn, 2);
  EXPECT_NEAR(std::log(scaled.severity / 2), 0, kNear);
  EXPECT_LT(strength({scaled.effect}), limit);
}

}  // namespace
}  // namespace umbsim::trial_testing
