// Pose uncertainty against finite differences, closed forms of straight and turn, and the information form of Kalman's
// update.
#include "odometry/uncertainty.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <iostream>

#include "core/random.h"

namespace umbsim {
namespace {

constexpr double kBase_m = 0.34;
constexpr double kRounding = 1e-12;

Pose2 moved(const Pose2& from, double left_m, double right_m) {
  return from * arc((left_m + right_m) / 2, (right_m - left_m) / kBase_m);
}

Eigen::Vector3d vector(const Pose2& p) { return {p.x_m, p.y_m, p.theta_rad}; }

TEST(ArcJacobians, AreTheDerivativesOfTheArc) {
  constexpr double kStep = 1e-5, kCentral = 1e-8;  // error of a central difference: step^2, and round-off over step
  const Pose2 from{1.2, -0.7, 0.9};
  double worst = 0;
  for (const auto& [left, right] : {std::pair{0.3, 0.3},
                                    {0.3, 0.31},
                                    {-0.2, 0.2},
                                    {0.004, 0.0040001},
                                    {0.0, 0.5},
                                    {-0.4, -0.1},
                                    {0.2, 2.5},
                                    {0.1, 0.1 + 0.0067},
                                    {0.1, 0.1 + 0.0069},
                                    {0.1, 0.1 - 0.0067},
                                    {0.5, 0.0}}) {
    const ArcJacobians j = arc_jacobians(from, left, right, kBase_m);
    for (int i = 0; i < 5; ++i) {
      const auto shifted = [&, left = left, right = right](double by) {  // Clang 14 captures no bindings
        const double d[5] = {i == 0 ? by : 0, i == 1 ? by : 0, i == 2 ? by : 0, i == 3 ? by : 0, i == 4 ? by : 0};
        const Pose2 start{from.x_m + d[0], from.y_m + d[1], from.theta_rad + d[2]};
        return vector(moved(start, left + d[3], right + d[4]));
      };
      const Eigen::Vector3d difference = (shifted(kStep) - shifted(-kStep)) / (2 * kStep);
      const Eigen::Vector3d exact = i < 3 ? Eigen::Vector3d(j.by_pose.col(i)) : Eigen::Vector3d(j.by_wheels.col(i - 3));
      worst = std::max(worst, (difference - exact).cwiseAbs().maxCoeff());
    }
  }
  std::cout << "Jacobians and central differences differ by " << worst << "\n";
  EXPECT_LT(worst, kCentral);
}

// A long way that hardly turns shows what the series of the arc's bend leaves out.
TEST(ArcJacobians, OfLongWaysThatHardlyTurn) {
  constexpr double kStep = 1e-4, kWay_m = 1e3;
  constexpr double kDifference = 2e-5;  // a way of kilometres has 1e-13 m of round-off, and bends by step^2
  for (const double turn_rad : {0.019, -0.019, 0.021}) {  // the series ends at 0.02
    const double left_m = kWay_m - turn_rad * kBase_m / 2, right_m = kWay_m + turn_rad * kBase_m / 2;
    const ArcJacobians j = arc_jacobians({}, left_m, right_m, kBase_m);
    const Eigen::Vector3d difference =
        (vector(moved({}, left_m, right_m + kStep)) - vector(moved({}, left_m, right_m - kStep))) / (2 * kStep);
    EXPECT_LT((difference - j.by_wheels.col(1)).cwiseAbs().maxCoeff(), kDifference) << turn_rad;
  }
}

PoseCovariance driven(double left_m, double right_m, const PathNoise& noise, int steps) {
  PoseCovariance P = PoseCovariance::Zero();
  Pose2 pose;
  for (int i = 0; i < steps; ++i) {
    P = after_arc(P, arc_jacobians(pose, left_m / steps, right_m / steps, kBase_m), left_m / steps, right_m / steps,
                  noise);
    pose = moved(pose, left_m / steps, right_m / steps);
  }
  return P;
}

// White noise of both wheels along a straight of length s: along k^2 s / 2, heading 2 k^2 s / b^2, and across its
// integral 2 k^2 s^3 / (3 b^2): the ellipse grows fastest across.
TEST(Covariance, OfAStraightIsTheClosedForm) {
  const double k = 0.0005, s = 3;
  constexpr int kSteps = 10000;
  constexpr double kOfSteps = 2.0 / kSteps;  // relative, of a sum for an integral
  const PoseCovariance P = driven(s, s, {k, k}, kSteps);
  const double heading = 2 * k * k * s / (kBase_m * kBase_m);
  EXPECT_NEAR(P(0, 0) / (k * k * s / 2), 1, kOfSteps);
  EXPECT_NEAR(P(2, 2) / heading, 1, kOfSteps);
  EXPECT_NEAR(P(1, 1) / (heading * s * s / 3), 1, kOfSteps);
  EXPECT_NEAR(P(1, 2) / (heading * s / 2), 1, kOfSteps);
  EXPECT_NEAR(P(0, 1), 0, kRounding);
  EXPECT_GT(P(1, 1), 100 * P(0, 0));
}

// A turn in place moves each wheel by b phi / 2: heading variance k^2 phi / b, and k^2 b phi / 4 of position in all.
TEST(Covariance, OfATurnInPlaceIsTheClosedForm) {
  const double k = 0.0005, phi = 2 * M_PI;
  constexpr double kOfArcs = 1e-5;  // relative: the chord of an arc of 2 pi / 1000
  const PoseCovariance P = driven(-kBase_m * phi / 2, kBase_m * phi / 2, {k, k}, 1000);
  EXPECT_NEAR(P(2, 2) / (k * k * phi / kBase_m), 1, 1e-9);
  EXPECT_NEAR((P(0, 0) + P(1, 1)) / (k * k * kBase_m * phi / 4), 1, kOfArcs);
}

TEST(Covariance, OfMirroredWheelsIsMirrored) {
  const PoseCovariance a = driven(1.0, 1.4, {0.0004, 0.0007}, 100), b = driven(1.4, 1.0, {0.0007, 0.0004}, 100);
  EXPECT_NEAR(a(0, 0), b(0, 0), kRounding);
  EXPECT_NEAR(a(1, 1), b(1, 1), kRounding);
  EXPECT_NEAR(a(0, 1), -b(0, 1), kRounding);
  EXPECT_NEAR(a(0, 2), -b(0, 2), kRounding);
  EXPECT_NEAR(a(1, 2), b(1, 2), kRounding);
}

TEST(Covariance, GrowsBackwardsAsForwards) {
  const PoseCovariance P = driven(-2, -2, {0.0005, 0.0005}, 10), Q = driven(2, 2, {0.0005, 0.0005}, 10);
  EXPECT_NEAR(P(0, 0), Q(0, 0), kRounding);
  EXPECT_NEAR(P(2, 2), Q(2, 2), kRounding);
}

// Independent errors: every coordinate is the mean weighted by the inverse variances.
TEST(AbsoluteFix, OfIndependentErrorsIsTheWeightedMean) {
  UncertainPose before{{1, 2, 0.5}, Eigen::Vector3d(4e-4, 1e-4, 1e-4).asDiagonal()};
  const UncertainPose after = absolute_fix(before, {1.01, 1.99, 0.52}, {0.01, 0.02});
  EXPECT_NEAR(after.X_OB.x_m, 1 + 0.01 * 4 / 5, kRounding);
  EXPECT_NEAR(after.X_OB.y_m, 2 - 0.01 / 2, kRounding);
  EXPECT_NEAR(after.X_OB.theta_rad, 0.5 + 0.02 / 5, kRounding);
  EXPECT_NEAR(after.covariance(0, 0), 4e-4 * 1e-4 / 5e-4, kRounding);
  EXPECT_NEAR(after.covariance(1, 1), 0.5e-4, kRounding);
  EXPECT_NEAR(after.covariance(2, 2), 1e-4 * 4e-4 / 5e-4, kRounding);
}

// In general the information adds up: P+^-1 = P^-1 + R^-1.
TEST(AbsoluteFix, AddsItsInformation) {
  constexpr double kInverse = 1e-6;  // relative: P is ill-conditioned
  const UncertainPose before{{}, driven(4.0, 4.3, {0.001, 0.0008}, 50)};
  const UncertainPose after = absolute_fix(before, {0.01, 0.02, 0.03}, {0.004, 0.003});
  const Eigen::Matrix3d R_inverse = Eigen::Vector3d(1 / 16e-6, 1 / 16e-6, 1 / 9e-6).asDiagonal();
  const Eigen::Matrix3d expected = before.covariance.inverse() + R_inverse;
  EXPECT_LT((after.covariance.inverse() - expected).norm() / expected.norm(), kInverse);
  const Eigen::Vector3d state = expected.inverse() * R_inverse * Eigen::Vector3d(0.01, 0.02, 0.03);
  EXPECT_NEAR(after.X_OB.x_m, state.x(), 1e-9);
  EXPECT_NEAR(after.X_OB.y_m, state.y(), 1e-9);
  EXPECT_NEAR(after.X_OB.theta_rad, state.z(), 1e-9);
  EXPECT_LT(ellipse_95(after.covariance).a_m, ellipse_95(before.covariance).a_m) << "it shrinks";
}

TEST(AbsoluteFix, TakesTheHeadingToTheNearestTurn) {
  const UncertainPose before{{0, 0, -2 * M_PI + 0.1}, Eigen::Matrix3d::Identity()};
  const UncertainPose after = absolute_fix(before, {0, 0, 0.1}, {0.1, 0.1});
  EXPECT_NEAR(after.X_OB.theta_rad, -2 * M_PI + 0.1, kRounding);
}

TEST(Ellipse95, HoldsNormalPositions95TimesInAHundred) {
  RandomStream random(1, "ellipse");
  const double c = std::cos(0.4), s = std::sin(0.4), a = 0.03, b = 0.004;
  PoseCovariance P = PoseCovariance::Zero();
  P(0, 0) = c * c * a * a + s * s * b * b;
  P(1, 1) = s * s * a * a + c * c * b * b;
  P(0, 1) = P(1, 0) = c * s * (a * a - b * b);
  const Ellipse e = ellipse_95(P);
  EXPECT_NEAR(e.a_m, a * std::sqrt(-2 * std::log(0.05)), kRounding);
  EXPECT_NEAR(e.b_m, b * std::sqrt(-2 * std::log(0.05)), kRounding);
  EXPECT_NEAR(e.angle_rad, 0.4, kRounding);
  constexpr int kDraws = 40000;
  int inside = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double u = random.normal(0, a), v = random.normal(0, b);
    inside += inside_95({{1, 2, 0}, P}, {1 + c * u - s * v, 2 + s * u + c * v, 0});
  }
  EXPECT_NEAR(double(inside) / kDraws, 0.95, 0.0044);  // four standard errors
}

// The covariance that counts and fixes leave, against that of the same arcs one by one.
TEST(UncertainReckoning, CarriesTheCovarianceOfItsArcs) {
  OdometryParameters parameters{0.075, 0.0751, kBase_m, 2000};
  const PathNoise noise{0.001, 0.002};
  for (const double scrub : {0.0, 0.01}) {
    parameters.scrub = scrub;
    UncertainReckoning reckoning(parameters, noise);
    PoseCovariance P = PoseCovariance::Zero();
    std::int64_t left = 0, right = 0;
    for (int i = 1; i <= 50; ++i) {
      const std::int64_t more_left = 100 + i % 5, more_right = i % 10 < 7 ? 130 : -90;
      const auto [left_m, right_m] = over_floor(parameters, {double(more_left) * parameters.left_metres_per_tick(),
                                                             double(more_right) * parameters.right_metres_per_tick()});
      P = after_arc(P, arc_jacobians(reckoning.pose(), left_m, right_m, kBase_m), left_m, right_m, noise);
      reckoning.update(left += more_left, right += more_right);
      EXPECT_LT((reckoning.estimate().covariance - P).norm(), kRounding * P.norm());
      if (i % 20 != 0) continue;
      const FixNoise fix{0.003, 0.002};
      const UncertainPose expected = absolute_fix({reckoning.pose(), P}, {0.1, 0.2, 0.3}, fix);
      reckoning.fix({0.1, 0.2, 0.3}, fix);
      P = expected.covariance;
      EXPECT_LT((reckoning.estimate().covariance - P).norm(), kRounding * P.norm());
      EXPECT_EQ(reckoning.pose().x_m, expected.X_OB.x_m);
    }
  }
}

TEST(UncertainReckoning, DoesNotChangeThePose) {
  const OdometryParameters parameters{0.075, 0.0751, kBase_m, 2000};
  DeadReckoning plain(parameters, {});
  UncertainReckoning uncertain(parameters, {0.001, 0.002});
  for (int i = 1; i <= 500; ++i) {
    plain.update(7 * i + i % 5, 9 * i - i % 3);
    uncertain.update(7 * i + i % 5, 9 * i - i % 3);
  }
  EXPECT_EQ(plain.pose().x_m, uncertain.pose().x_m);
  EXPECT_EQ(plain.pose().y_m, uncertain.pose().y_m);
  EXPECT_EQ(plain.pose().theta_rad, uncertain.pose().theta_rad);
  EXPECT_GT(uncertain.estimate().covariance(0, 0), 0);
  uncertain.fix({0.1, 0.2, 0.3}, {1e-9, 1e-9});
  EXPECT_NEAR(uncertain.pose().x_m, 0.1, 1e-8) << "a perfect measurement is believed";
}

}  // namespace
}  // namespace umbsim
