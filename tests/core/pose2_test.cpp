#include "core/pose2.h"

#include <gtest/gtest.h>

#include <vector>

namespace umbsim {
namespace {

constexpr double kRoundOff = 1e-14;  // a few roundings of numbers of order 1

const std::vector<Pose2> kPoses = {{0, 0, 0}, {1, -2, 0.5}, {-0.3, 0.7, -2.9}, {2, 1, 7.5}, {0.1, 0, M_PI}};

void expect_same(const Pose2& a, const Pose2& b, double tolerance) {
  EXPECT_NEAR(a.x_m, b.x_m, tolerance);
  EXPECT_NEAR(a.y_m, b.y_m, tolerance);
  EXPECT_NEAR(a.theta_rad, b.theta_rad, tolerance);
}

TEST(Pose2, GroupLaws) {
  const Pose2 identity;
  for (const Pose2& A : kPoses) {
    expect_same(A * identity, A, 0);
    expect_same(identity * A, A, 0);
    expect_same(A * inverse(A), identity, kRoundOff);
    expect_same(inverse(A) * A, identity, kRoundOff);
    for (const Pose2& B : kPoses) {
      expect_same(inverse(A * B), inverse(B) * inverse(A), kRoundOff);
      for (const Pose2& C : kPoses) expect_same((A * B) * C, A * (B * C), kRoundOff);
    }
  }
}

TEST(Pose2, TurnedLeftTheWayAheadIsY) {
  const Pose2 X_WB{1, 2, M_PI / 2};
  expect_same(X_WB * Pose2{3, 0, 0}, {1, 5, M_PI / 2}, kRoundOff);
  expect_same(X_WB * Pose2{0, 3, 0}, {-2, 2, M_PI / 2}, kRoundOff);
}

TEST(Pose2, HeadingIsNotWrapped) { EXPECT_EQ((Pose2{0, 0, 5} * Pose2{0, 0, 5}).theta_rad, 10); }

// The path x' = cos(theta), y' = sin(theta) by the midpoint rule, whose error is ds dtheta^2 / (24 n^2).
Pose2 integrated_arc(double ds_m, double dtheta_rad, int steps) {
  Pose2 pose;
  for (int i = 0; i < steps; ++i) {
    const double middle = dtheta_rad * (i + 0.5) / steps;
    pose.x_m += ds_m / steps * std::cos(middle);
    pose.y_m += ds_m / steps * std::sin(middle);
  }
  pose.theta_rad = dtheta_rad;
  return pose;
}

TEST(Pose2, ArcIsTheIntegralOfTheMotion) {
  constexpr int kSteps = 20000;
  for (const double dtheta : {0.0, 1e-9, 1e-3, -0.3, M_PI / 2, -M_PI, 2 * M_PI, 9.0}) {
    constexpr double kLength = 1.7;
    const double midpoint_error = kLength * dtheta * dtheta / (24.0 * kSteps * kSteps);
    constexpr double kSummation = 1e-12;  // 20000 roundings of a sum of order 1
    expect_same(arc(kLength, dtheta), integrated_arc(kLength, dtheta, kSteps), midpoint_error + kSummation);
  }
}

TEST(Pose2, ArcOfKnownCircles) {
  // Radius 2 to the left: a quarter ends 2 ahead and 2 to the left, a full circle where it began.
  expect_same(arc(2 * M_PI / 2, M_PI / 2), {2, 2, M_PI / 2}, kRoundOff);
  expect_same(arc(4 * M_PI, 2 * M_PI), {0, 0, 2 * M_PI}, kRoundOff);
}

TEST(Pose2, ArcsOfOneCircleAdd) {
  constexpr double kCurvature = 0.8;
  for (const double first : {0.1, 1.0, -2.0}) {
    expect_same(arc(first, kCurvature * first) * arc(0.7, kCurvature * 0.7),
                arc(first + 0.7, kCurvature * (first + 0.7)), kRoundOff);
  }
}

TEST(Pose2, ArcMirrors) {
  const Pose2 left = arc(1.2, 0.4), right = arc(1.2, -0.4);
  EXPECT_EQ(left.x_m, right.x_m);
  EXPECT_EQ(left.y_m, -right.y_m);
  expect_same(arc(-1.2, -0.4), inverse(left), kRoundOff);
}

TEST(Pose2, TinyArcsKeepTheirSidewaysPart) {
  // y = ds dtheta/2 to first order; an implementation that falls back to a straight line would lose it.
  for (const double dtheta : {1e-3, 1e-5, 1e-8, 1e-12}) {
    constexpr double kSecondOrder = 1.0 / 12;  // next term of y: ds dtheta^3/24
    EXPECT_NEAR(arc(1, dtheta).y_m / (dtheta / 2), 1, kSecondOrder * dtheta * dtheta + kRoundOff);
  }
}

TEST(Pose2, SincMeetsItsSeries) {
  EXPECT_EQ(sinc(0), 1);
  for (const double x : {0.9999e-4, 1.0001e-4, -0.9999e-4}) EXPECT_NEAR(sinc(x), std::sin(x) / x, kRoundOff);
}

TEST(Pose2, WrapAngle) {
  constexpr double kAngleRoundOff = 1e-13;  // 2 pi in doubles, some ten times over
  EXPECT_EQ(wrap_angle(M_PI), M_PI);
  EXPECT_EQ(wrap_angle(-M_PI), M_PI) << "the range is (-pi, pi]";
  EXPECT_EQ(wrap_angle(0.5), 0.5);
  for (int turns = -9; turns <= 9; ++turns) {
    for (const double angle : {-3.0, -0.1, 0.0, 2.0}) {
      EXPECT_NEAR(wrap_angle(angle + turns * 2 * M_PI), angle, kAngleRoundOff);
    }
  }
}

TEST(Pose2, DegreesAndRadians) {
  EXPECT_EQ(degrees(M_PI), 180);
  EXPECT_NEAR(radians(degrees(1.234)), 1.234, kRoundOff);
}

}  // namespace
}  // namespace umbsim
