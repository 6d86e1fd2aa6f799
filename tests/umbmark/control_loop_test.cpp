// Where the driver's loop stops settling: against closed forms, for each kind of delay.
#include "umbmark/control_loop.h"

#include <gtest/gtest.h>

#include <cmath>

namespace umbsim {
namespace {

constexpr double kSpeed_mps = 0.2;
// Growth is told from decay over 50 spans of the slowest part: an error may change by a hundredth of a per mille.
constexpr double kNear = 2e-3;

double furthest(LoopTiming timing, double LoopTiming::*member, double from, double to, double speed_mps) {
  timing.*member = to;
  EXPECT_FALSE(settles(timing, speed_mps));
  return limit(timing, member, from, speed_mps).value();
}

// A held correction of the heading takes heading * interval of the error: twice the error and it swings for ever.
// Across the path nothing is added: in this swing the robot's mean heading is that of its path.
TEST(ControlLoop, HeldCountsSettleUpToTwiceTheErrorEachTime) {
  LoopTiming t;
  t.period_s = t.step_s = 1e-3;
  for (const double speed : {0.0, kSpeed_mps}) {
    EXPECT_NEAR(furthest(t, &LoopTiming::sampling_s, 0, 1, speed), 2 / kDriver.heading, 0.01);
  }
}

// z^(d+1) (z - 1) = -(k T / 2) (z + 1) on the unit circle: k T = 2 tan(pi / (4 (d + 1))) with d periods of delay, where
// commands are ramps over one period in many steps. Turning in place, where the heading is all.
TEST(ControlLoop, InPlaceTheRateForDelaysOfWholePeriods) {
  for (const int d : {0, 1, 2, 5}) {
    const double by_hand = 2 * std::tan(M_PI / (4 * (d + 1))) / kDriver.heading;
    for (const double share : {1 - kNear, 1 + kNear}) {
      LoopTiming t;
      t.period_s = share * by_hand;
      t.step_s = t.period_s / 2000;
      t.latency_s = d * t.period_s;
      EXPECT_EQ(settles(t, 0), share < 1) << d << " periods";
    }
  }
}

// On a leg: the dead time that takes the phase margin of (h s + a^2) / s^2. |L| = 1 where w^4 = h^2 w^2 + a^4.
TEST(ControlLoop, OnALegTheDeadTimeIsThePhaseMargin) {
  const double h = kDriver.heading, a2 = kDriver.across * kDriver.across;
  const double w = std::sqrt((h * h + std::sqrt(h * h * h * h + 4 * a2 * a2)) / 2);
  const double dead_time_s = std::atan(h * w / a2) / w;
  EXPECT_NEAR(dead_time_s, 0.2158, 1e-4);
  LoopTiming t;
  t.period_s = t.step_s = 1e-3;  // one step: the set-point stands for a period, half a period of delay
  EXPECT_NEAR(furthest(t, &LoopTiming::latency_s, 0, 1, kSpeed_mps) + t.period_s / 2, dead_time_s, t.period_s);
}

// With a lag the loop is (h s + a^2) / (s^2 (T s + 1)): by Routh it settles while h > a^2 T.
TEST(ControlLoop, MotorsMayLagUntilRouthsLimit) {
  LoopTiming t;
  t.period_s = t.step_s = 1e-3;
  const double by_hand = kDriver.heading / (kDriver.across * kDriver.across);
  EXPECT_NEAR(furthest(t, &LoopTiming::lag_s, 0, 5, kSpeed_mps), by_hand, 5e-3);
}

// Motors that follow half a period late leave a / 2 T of the speed for the driver to correct, at its gain: 1 + k T / 2
// at first, if set-points are ramps.
TEST(ControlLoop, AtTheStartOfARampTheDriverAddsHalfAPeriodTimesItsGain) {
  for (const double period_s : {0.005, 0.01, 0.02}) {
    LoopTiming t;
    t.period_s = period_s;
    t.step_s = period_s / 100;
    EXPECT_NEAR(overshoot(t, kDriver.along, 1), 1 + kDriver.along * period_s / 2, 0.1 * kDriver.along * period_s / 2);
  }
}

TEST(ControlLoop, NothingHelpsWhereAnotherPartIsTooSlow) {
  LoopTiming t;
  t.sampling_s = t.latency_s = 1;
  EXPECT_FALSE(limit(t, &LoopTiming::latency_s, 0, kSpeed_mps));
}

}  // namespace
}  // namespace umbsim
