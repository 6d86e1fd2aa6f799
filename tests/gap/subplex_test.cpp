#include "gap/search/subplex.h"

#include <gtest/gtest.h>

#include <cmath>

namespace umbsim::gap {
namespace {

const Eigen::Vector2d kMin(-10, -10);
const Eigen::Vector2d kMax(10, 10);

double hill(const Eigen::VectorXd& x) { return -100 * std::abs(x[0] - 1.3) - 200 * std::abs(x[1] + 0.7); }

TEST(Subplex, ClimbsAHillWithoutDerivatives) {
  const Eigen::VectorXd top = subplex(hill, Eigen::Vector2d(0, 0), Eigen::Vector2d(0.5, 0.5), kMin, kMax, 0.01, 200);
  EXPECT_NEAR(top[0], 1.3, 0.02);
  EXPECT_NEAR(top[1], -0.7, 0.02);
}

// The length of a hole and its place: where its edge lies is told well, and its middle badly.
TEST(Subplex, FollowsARidgeThatRunsAcrossBothNumbers) {
  const auto ridge = [](const Eigen::VectorXd& x) {
    return -1000 * std::pow(x[0] - x[1], 2) - 10 * std::pow(x[0] + x[1] - 6, 2);
  };
  const Eigen::VectorXd top = subplex(ridge, Eigen::Vector2d(0, 0), Eigen::Vector2d(0.5, 0.5), kMin, kMax, 0.01, 400);
  EXPECT_NEAR(top[0], 3, 0.05);
  EXPECT_NEAR(top[1], 3, 0.05);
}

TEST(Subplex, StaysInsideItsBounds) {
  const Eigen::VectorXd top = subplex([](const Eigen::VectorXd& x) { return x[0] + x[1]; }, Eigen::Vector2d(0, 0),
                                      Eigen::Vector2d(3, 3), kMin, kMax, 0.1, 200);
  EXPECT_EQ(top, kMax);
}

TEST(Subplex, AsksNoMoreThanItMay) {
  int asked = 0;
  subplex([&](const Eigen::VectorXd& x) { return ++asked, hill(x); }, Eigen::Vector2d(0, 0),
          Eigen::Vector2d(0.01, 0.01), kMin, kMax, 1e-6, 15);
  EXPECT_LE(asked, 15);
}

TEST(Subplex, IsNeverWorseThanItsStart) {
  const auto cliff = [](const Eigen::VectorXd& x) { return x[0] == 1 && x[1] == 1 ? 0.0 : -1e300; };
  const Eigen::Vector2d only(1, 1);
  EXPECT_EQ(subplex(cliff, only, Eigen::Vector2d(0.5, 0.5), kMin, kMax, 0.1, 50), only);
}

}  // namespace
}  // namespace umbsim::gap
