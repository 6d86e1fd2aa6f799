// Systematic and non-systematic shares of the return error.
#include <gtest/gtest.h>

#include "umbmark/figures.h"

namespace umbsim {
namespace {

constexpr double kShareRoundOff = 1e-12;

// Four end points round (30, 40) mm, at a distance of 10 mm.
Cluster cross() {
  return cluster({{"a", 0.040, 0.040, 0}, {"b", 0.020, 0.040, 0}, {"c", 0.030, 0.050, 0}, {"d", 0.030, 0.030, 0}});
}

TEST(ErrorShares, AreTheSquaresOfCentreAndSpread) {
  const ErrorShares s = error_shares(cross());
  EXPECT_NEAR(s.systematic_m, 0.050, kShareRoundOff);
  EXPECT_NEAR(s.non_systematic_m, 0.010, kShareRoundOff);
  EXPECT_NEAR(s.rms_m * s.rms_m, 0.0026, kShareRoundOff);
  EXPECT_NEAR(s.systematic, 25.0 / 26, kShareRoundOff);
  EXPECT_NEAR(s.non_systematic, 1.0 / 26, kShareRoundOff);
}

TEST(ErrorShares, TheMeanSquareErrorIsTheirSum) {
  const Cluster c = cluster({{"a", 0.01, -0.02, 0}, {"b", 0.03, 0.05, 0}, {"c", -0.04, 0.01, 0}});
  double mean_square = 0;
  for (const ReturnError& e : c.errors) mean_square += (e.x_m * e.x_m + e.y_m * e.y_m) / 3;
  EXPECT_NEAR(error_shares(c).rms_m, std::sqrt(mean_square), kShareRoundOff);
  EXPECT_NEAR(error_shares(c).systematic + error_shares(c).non_systematic, 1, kShareRoundOff);
}

TEST(ErrorShares, OfBothDirectionsAreMeansOfTheSquares) {
  const ErrorShares both = error_shares({error_shares(cross()), error_shares(cluster({{"e", 0, 0, 0}}))});
  EXPECT_NEAR(both.rms_m * both.rms_m, 0.0013, kShareRoundOff);
  EXPECT_NEAR(both.systematic, 25.0 / 26, kShareRoundOff);
}

TEST(ErrorShares, OneRunHasNoSpreadAndNoErrorHasNoShares) {
  const ErrorShares one = error_shares(cluster({{"a", 0.03, 0.04, 0}}));
  EXPECT_EQ(one.non_systematic_m, 0);
  EXPECT_NEAR(one.rms_m, 0.05, kShareRoundOff);
  const ErrorShares none = error_shares(cluster({{"a", 0, 0, 0}, {"b", 0, 0, 0}}));
  EXPECT_EQ(none.systematic, 0);
  EXPECT_EQ(none.non_systematic, 0);
}

TEST(ErrorShares, TwoRunsHaveASpread) {
  const ErrorShares s = error_shares(cluster({{"a", 0.03, 0.01, 0}, {"b", 0.03, -0.01, 0}}));
  EXPECT_DOUBLE_EQ(s.systematic_m, 0.03);
  EXPECT_DOUBLE_EQ(s.non_systematic_m, 0.01);
}

}  // namespace
}  // namespace umbsim
