// The sweeps of scenarios/sweeps/ meet their own expectations.
#include "tests/acceptance/sweep_program.h"

namespace umbsim::acceptance {
namespace {

class Shipped : public testing::TestWithParam<const char*> {};

TEST_P(Shipped, MeetsItsExpectations) {
  const Desk desk;
  std::vector<std::string> words{"sweep", shipped(std::string("sweeps/") + GetParam()), "--junit", "junit.xml"};
  // 5 x 5 points of the 21 x 21.
  if (std::string(GetParam()) == "recovery") {
    words.insert(words.end(), {"--axis", "effects.wheel_radius_difference.relative={from: -0.01, to: 0.01, count: 5}",
                               "--axis", "effects.wheelbase.relative={from: -0.04, to: 0.04, count: 5}"});
  }
  const Outcome outcome = desk.umbsim(words);
  EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  expect_says(outcome.out, {"Expectations", "met "});
  EXPECT_TRUE(fs::exists(desk.home / "results" / GetParam() / "report.html"));
  expect_says(text_of(desk.home / "junit.xml"), {"failures=\"0\""});
}

INSTANTIATE_TEST_SUITE_P(Sweep, Shipped,
                         testing::Values("recovery", "bump_height", "friction", "encoder_resolution", "sampling",
                                         "square_side"),
                         [](const auto& sweep) { return std::string(sweep.param); });

TEST(ShippedSweeps, AreAllTested) {
  EXPECT_EQ(listing(fs::path(UMBSIM_SOURCE_DIR) / "scenarios/sweeps"),
            (std::set<std::string>{"recovery.yaml", "bump_height.yaml", "friction.yaml", "encoder_resolution.yaml",
                                   "sampling.yaml", "square_side.yaml"}));
}

}  // namespace
}  // namespace umbsim::acceptance
