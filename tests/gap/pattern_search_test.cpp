#include "gap/search/pattern_search.h"

#include <gtest/gtest.h>

namespace umbsim::gap {
namespace {

const Eigen::Vector2d kMin(-10, -10);
const Eigen::Vector2d kMax(10, 10);

double hill(const Eigen::VectorXd& x) { return -std::abs(x[0] - 1.3) - 2 * std::abs(x[1] + 0.7); }

TEST(PatternSearch, ClimbsAHillWithoutDerivatives) {
  const Eigen::VectorXd top =
      pattern_search(hill, Eigen::Vector2d(0, 0), Eigen::Vector2d(0.5, 0.5), kMin, kMax, 6, 200);
  EXPECT_NEAR(top[0], 1.3, 0.02);
  EXPECT_NEAR(top[1], -0.7, 0.02);
}

TEST(PatternSearch, FollowsARidgeThatRunsAcrossBothNumbers) {
  const auto ridge = [](const Eigen::VectorXd& x) { return -10 * std::abs(x[0] - x[1]) - std::abs(x[0] + x[1] - 6); };
  const Eigen::VectorXd top =
      pattern_search(ridge, Eigen::Vector2d(0, 0), Eigen::Vector2d(0.5, 0.5), kMin, kMax, 4, 400);
  EXPECT_NEAR(top[0], 3, 0.05);
  EXPECT_NEAR(top[1], 3, 0.05);
}

TEST(PatternSearch, StaysInsideItsBounds) {
  const Eigen::VectorXd top = pattern_search([](const Eigen::VectorXd& x) { return x[0] + x[1]; },
                                             Eigen::Vector2d(0, 0), Eigen::Vector2d(3, 3), kMin, kMax, 2, 200);
  EXPECT_EQ(top, kMax);
}

TEST(PatternSearch, AsksNoMoreThanItMay) {
  int asked = 0;
  pattern_search([&](const Eigen::VectorXd& x) { return ++asked, hill(x); }, Eigen::Vector2d(0, 0),
                 Eigen::Vector2d(0.01, 0.01), kMin, kMax, 20, 15);
  EXPECT_LE(asked, 15);
}

}  // namespace
}  // namespace umbsim::gap
