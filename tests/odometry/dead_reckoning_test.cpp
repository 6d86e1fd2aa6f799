// Dead reckoning against circles in closed form, fine Euler integration, and the resolution of one tick.
#include "odometry/dead_reckoning.h"

#include <gtest/gtest.h>

#include <iostream>

#include "odometry/encoder.h"

namespace umbsim {
namespace {

constexpr double kRoundOff = 1e-12;

const OdometryParameters kLabmate{0.075, 0.075, 0.340, 2000};
const OdometryParameters kFine{0.075, 0.0751, 0.340, 1e6};

Pose2 after(const OdometryParameters& parameters, std::int64_t left, std::int64_t right, int updates = 1,
            const Pose2& start = {}) {
  DeadReckoning reckoning(parameters, start);
  for (int i = 1; i <= updates; ++i) reckoning.update(left * i / updates, right * i / updates);
  return reckoning.pose();
}

TEST(DeadReckoning, StraightIsTheCircumferencePerTurn) {
  const Pose2 pose = after(kLabmate, 4000, 4000, 10);
  EXPECT_NEAR(pose.x_m, 2 * 2 * M_PI * 0.075, kRoundOff);
  EXPECT_EQ(pose.y_m, 0);
  EXPECT_EQ(pose.theta_rad, 0);
}

TEST(DeadReckoning, OneWheelAloneTurnsAboutTheOther) {
  const Pose2 pose = after(kLabmate, 0, 1000);  // half a turn of the right wheel about the left one
  const double turn = M_PI * 0.075 / 0.340;
  EXPECT_NEAR(pose.theta_rad, turn, kRoundOff);
  EXPECT_NEAR(pose.x_m, 0.17 * std::sin(turn), kRoundOff);
  EXPECT_NEAR(pose.y_m, 0.17 * (1 - std::cos(turn)), kRoundOff);
}

// Along one circle it cannot matter how often the ticks are read, not even once for several turns.
TEST(DeadReckoning, ArcsAreExactForAnyInterval) {
  constexpr double kThousandUpdates = 1e-11;
  for (const std::int64_t right : {800000, 1000000, 5000000, -700000}) {
    const Pose2 whole = after(kFine, 1000000, right);
    const Pose2 parts = after(kFine, 1000000, right, 1000);
    EXPECT_NEAR(whole.x_m, parts.x_m, kThousandUpdates);
    EXPECT_NEAR(whole.y_m, parts.y_m, kThousandUpdates);
    EXPECT_NEAR(whole.theta_rad, parts.theta_rad, kThousandUpdates);
  }
}

// The arc as the limit of Euler's method, whose error halves with its step: extrapolated, it is of second order.
TEST(DeadReckoning, ArcIsTheLimitOfEuler) {
  const double left_m = 1.0, right_m = 1.3, turn = (right_m - left_m) / 0.340;
  const auto euler = [&](int steps) {
    Pose2 p{0, 0, 0.3};
    for (int i = 0; i < steps; ++i) {
      p.x_m += (left_m + right_m) / 2 / steps * std::cos(p.theta_rad);
      p.y_m += (left_m + right_m) / 2 / steps * std::sin(p.theta_rad);
      p.theta_rad += turn / steps;
    }
    return p;
  };
  const OdometryParameters per_micrometre{1 / (2 * M_PI), 1 / (2 * M_PI), 0.340, 1e6};
  const Pose2 exact = after(per_micrometre, 1000000, 1300000, 1, {0, 0, 0.3});
  double last = 0;
  for (const int steps : {1000, 2000, 4000}) {
    const Pose2 p = euler(steps);
    const double error = std::hypot(p.x_m - exact.x_m, p.y_m - exact.y_m);
    if (last > 0) {
      EXPECT_NEAR(last / error, 2, 0.01);  // first order; the next term is 1 / steps of it
    }
    last = error;
  }
  const Pose2 coarse = euler(20000), fine = euler(40000);
  constexpr double kExtrapolated = 1e-8;  // (1 / 40000)^2, and round-off of as many sums
  EXPECT_NEAR(2 * fine.x_m - coarse.x_m, exact.x_m, kExtrapolated);
  EXPECT_NEAR(2 * fine.y_m - coarse.y_m, exact.y_m, kExtrapolated);
  EXPECT_NEAR(fine.theta_rad, exact.theta_rad, kExtrapolated);
}

// PHYSICS: with 2000 ticks one tick is 0.24 mm at the wheel and 0.04 degrees of heading.
TEST(DeadReckoning, OneTickIsTheResolution) {
  const Pose2 pose = after(kLabmate, 0, 1);
  const double turn = 2 * M_PI * 0.075 / 2000 / 0.340;
  EXPECT_NEAR(pose.theta_rad, turn, kRoundOff);
  EXPECT_NEAR(pose.x_m, 0.17 * std::sin(turn), kRoundOff) << "about the left wheel";
  EXPECT_NEAR(kLabmate.right_metres_per_tick(), 0.00024, 0.000005);
  EXPECT_NEAR(degrees(pose.theta_rad), 0.04, 0.0005);
  std::cout << "one tick: " << 1000 * kLabmate.right_metres_per_tick() << " mm, " << degrees(pose.theta_rad)
            << " deg\n";
}

TEST(DeadReckoning, ForthAndBackReturns) {
  DeadReckoning reckoning(kFine, {1, 2, 0.5});
  for (int i = 1; i <= 100; ++i) reckoning.update(1000 * i, 1500 * i);
  for (int i = 99; i >= 0; --i) reckoning.update(1000 * i, 1500 * i);
  EXPECT_NEAR(reckoning.pose().x_m, 1, kRoundOff);
  EXPECT_NEAR(reckoning.pose().y_m, 2, kRoundOff);
  EXPECT_NEAR(reckoning.pose().theta_rad, 0.5, kRoundOff);
}

TEST(DeadReckoning, MirroredTicksMirrorThePath) {
  const OdometryParameters even{0.075, 0.075, 0.340, 2000};
  DeadReckoning a(even, {}), b(even, {});
  for (int i = 1; i <= 500; ++i) {
    a.update(7 * i + i % 5, 9 * i - i % 3);
    b.update(9 * i - i % 3, 7 * i + i % 5);
  }
  EXPECT_EQ(a.pose().x_m, b.pose().x_m);
  EXPECT_EQ(a.pose().y_m, -b.pose().y_m);
  EXPECT_EQ(a.pose().theta_rad, -b.pose().theta_rad);
}

TEST(DeadReckoning, CountsFromTheFirstReading) {
  DeadReckoning reckoning(kLabmate, {}, 123456, -98765);
  reckoning.update(123456 + 2000, -98765 + 2000);
  EXPECT_NEAR(reckoning.pose().x_m, 2 * M_PI * 0.075, kRoundOff);
  EXPECT_EQ(reckoning.pose().theta_rad, 0);
}

EncoderSpec encoder(double ticks_per_revolution, double rate_hz) {
  EncoderSpec spec;
  spec.ticks_per_revolution = ticks_per_revolution;
  spec.rate_hz = rate_hz;
  return spec;
}

TEST(Encoder, RoundsToTheNearestTickAlikeForwardAndBackward) {
  const EncoderSpec spec = encoder(2000, 50);
  const double tick = 2 * M_PI / 2000;
  EXPECT_EQ(ticks(spec, 0.49 * tick), 0);
  EXPECT_EQ(ticks(spec, 0.51 * tick), 1);
  EXPECT_EQ(ticks(spec, 2 * M_PI), 2000);
  for (int i = 0; i < 10000; ++i) {
    const double angle = 0.123 * i * tick;
    EXPECT_EQ(ticks(spec, -angle), -ticks(spec, angle));
    EXPECT_LE(std::abs(double(ticks(spec, angle)) - angle / tick), 0.5 + 1e-9);
  }
}

TEST(Encoder, TicksPerRevolutionMayBeFractional) {
  const EncoderSpec spec = encoder(2796.8, 20);
  EXPECT_EQ(ticks(spec, 2 * M_PI * 10), 27968);
}

// Creep against turning, by hand: a share of all that a wheel rolls, forwards and backwards, to either side.
TEST(OverFloor, TakesItsShareOfTurnsAndArcs) {
  constexpr double kScrub = 0.01, kHardly = 0.06;
  const auto taken = [&](double left_m, double right_m) {
    OdometryParameters p = kLabmate;
    p.scrub = kScrub;
    const RolledWays over = over_floor(p, {left_m, right_m});
    return std::pair{over.left_m - left_m, right_m - over.right_m};
  };
  const double on_the_spot = kScrub * 2 / std::hypot(2, kHardly);  // the bend of a turn in place is 2
  for (const double way_m : {0.3, -0.3}) {
    const auto [left, right] = taken(-way_m, way_m);
    const double share = way_m > 0 ? on_the_spot : -on_the_spot;
    EXPECT_NEAR(left, share * 0.3, kRoundOff);
    EXPECT_NEAR(right, share * 0.3, kRoundOff);
  }
  for (const double bend : {0.02, 0.06, 0.4, -0.4}) {
    for (const double way_m : {2.0, -2.0}) {
      const double left_m = way_m - bend * std::abs(way_m) / 2, right_m = way_m + bend * std::abs(way_m) / 2;
      const double share = kScrub * bend / std::hypot(bend, kHardly);
      const auto [left, right] = taken(left_m, right_m);
      EXPECT_NEAR(left, share * std::abs(left_m), kRoundOff) << bend;
      EXPECT_NEAR(right, share * std::abs(right_m), kRoundOff) << bend;
    }
  }
  EXPECT_EQ(taken(1.5, 1.5), (std::pair{0.0, 0.0})) << "straight ahead";
  EXPECT_EQ(taken(0, 0), (std::pair{0.0, 0.0})) << "standing";
  const RolledWays without = over_floor(kLabmate, {1, 2});
  EXPECT_EQ(without.left_m, 1);
  EXPECT_EQ(without.right_m, 2);
}

// An arc of radius R is small by scrub 2R/b.
TEST(OverFloor, MakesArcsSmallByTheirRadius) {
  constexpr double kScrub = 0.001, kRadius_m = 0.5;
  OdometryParameters p = kLabmate;
  p.scrub = kScrub;
  const double half_m = p.wheelbase_m / 2;
  const RolledWays over = over_floor(p, {kRadius_m - half_m, kRadius_m + half_m});  // one radian
  EXPECT_NEAR(1 - (over.right_m - over.left_m) / p.wheelbase_m, kScrub * kRadius_m / half_m,
              0.005 * kScrub * kRadius_m / half_m);
}

}  // namespace
}  // namespace umbsim
