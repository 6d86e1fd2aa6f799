#include "gap/trial/draw/effect_draws.h"

#include <algorithm>
#include <set>

#include "tests/gap/trial/fake_simulator.h"

namespace umbsim::trial_testing {
namespace {

constexpr int kDraws = 50;
constexpr double kRoundOff = 1e-9;

double value(const Effect& e, const std::string& name) {
  for (std::size_t i = 0; i < e.info->parameters.size(); ++i) {
    if (e.info->parameters[i].name == name) return e.values.numbers[i];
  }
  throw std::out_of_range(name);
}

class EveryEffect : public testing::TestWithParam<std::size_t> {
 protected:
  const EffectInfo& info = catalogue()[GetParam()];
  const TrialPlan plan = small_plan();
  const Platform platform = draw_platform(plan, 0);
};

TEST_P(EveryEffect, IsDrawnWithinItsBoundsAtAnyStrength) {
  for (int i = 0; i < kDraws; ++i) {
    RandomStream random(3, "test", std::uint64_t(i));
    const DrawnEffect drawn = draw_effect(info, platform, plan.runs, random);
    ASSERT_FALSE(drawn.amplitude.empty());
    ASSERT_GT(drawn.range.min, 0);
    ASSERT_GT(drawn.range.max, drawn.range.min);
    for (const double a : {drawn.range.min, drawn.plausible.min, drawn.range.max}) {
      const Effect effect = drawn.at(a);
      for (std::size_t k = 0; k < info.parameters.size(); ++k) {
        EXPECT_TRUE(info.parameters[k].bounds.contains(effect.values.numbers[k]))
            << info.parameters[k].name << " = " << effect.values.numbers[k];
      }
    }
  }
}

TEST_P(EveryEffect, GrowsFromNeutralToThePlausibleMaximum) {
  RandomStream random(3, "test");
  const DrawnEffect drawn = draw_effect(info, platform, plan.runs, random);
  const std::vector<std::string> strengths = strength_parameters(info.name);
  ASSERT_FALSE(strengths.empty());
  for (const AmplitudeParameter& p : drawn.amplitude) {
    const EffectParameter& parameter = info.parameters[p.index];
    EXPECT_NE(std::find(strengths.begin(), strengths.end(), parameter.name), strengths.end()) << parameter.name;
    const double strongest = drawn.at(drawn.range.max).values.numbers[p.index];
    const double plausible = p.reciprocal ? parameter.plausible_min : parameter.plausible_max;
    // No contact is wider than its wheel.
    const double most = info.name == "contact_patch" ? std::min(plausible, kTrialWheelWidth_m) : plausible;
    EXPECT_NEAR(std::abs(strongest), most, kRoundOff);
  }
}

TEST_P(EveryEffect, HasEveryStrengthParameterInTheCatalogue) {
  for (const std::string& strength : strength_parameters(info.name)) {
    EXPECT_NO_THROW(value(neutral_effect(info), strength)) << strength;
  }
}

INSTANTIATE_TEST_SUITE_P(Catalogue, EveryEffect, testing::Range(std::size_t(0), catalogue().size()),
                         [](const auto& param_info) { return catalogue()[param_info.param].name; });

// On the plain square, a wheel's track is half a wheelbase beside the line of a leg.
TEST(Places, ABumpLiesOnAWheelsTrackAndAcrossIt) {
  const TrialPlan plan = small_plan();
  const Platform platform = draw_platform(plan, 0);
  const double side = platform.side_m, half = platform.robot.wheelbase_m / 2;
  std::set<int> quarters;
  for (int i = 0; i < kDraws; ++i) {
    RandomStream random(4, "test", std::uint64_t(i));
    const Effect bump = draw_effect(find_effect("bump"), platform, plan.runs, random).at(0.005);
    const double x = value(bump, "x_m"), y = std::abs(value(bump, "y_m"));  // cw is ccw mirrored
    const bool along_x = std::abs(std::sin(value(bump, "direction_rad"))) > 0.5;
    const double beside =
        along_x ? std::min(std::abs(y), std::abs(y - side)) : std::min(std::abs(x), std::abs(x - side));
    EXPECT_NEAR(beside, half, kRoundOff);
    const double along = along_x ? x : y;
    EXPECT_GE(along, 0.15 * side - kRoundOff);
    EXPECT_LE(along, 0.85 * side + kRoundOff);
    quarters.insert(int(std::lround(value(bump, "direction_rad") / (M_PI / 2))));
  }
  EXPECT_GE(quarters.size(), 3u) << "legs of every direction are drawn";
}

TEST(Places, WhatActsOnTurnsLiesWhereAWheelPassesAtACorner) {
  const TrialPlan plan = small_plan();
  const Platform platform = draw_platform(plan, 1);
  const double side = platform.side_m, half = platform.robot.wheelbase_m / 2;
  for (const char* name : {"slippery_patch", "wheel_lift"}) {
    for (int i = 0; i < kDraws; ++i) {
      RandomStream random(5, name, std::uint64_t(i));
      const DrawnEffect drawn = draw_effect(find_effect(name), platform, plan.runs, random);
      const Effect effect = drawn.at(drawn.range.max);
      const double x = value(effect, "x_m"), y = std::abs(value(effect, "y_m"));
      double nearest = 1e9;
      for (const double cx : {0.0, side}) {
        for (const double cy : {0.0, side}) nearest = std::min(nearest, std::abs(std::hypot(x - cx, y - cy) - half));
      }
      // The mirrored square of cw: |y| near its zero line is the same corner.
      EXPECT_NEAR(nearest, 0, kRoundOff) << name;
    }
  }
}

TEST(Places, APushHappensInOneOfTheRunsOfTheCaseDuringItsLeg) {
  const TrialPlan plan = small_plan();
  const Platform platform = draw_platform(plan, 0);
  std::set<std::string> ids, pushed;
  for (const PlannedRun& run : plan.runs) ids.insert(run.id);
  for (int i = 0; i < kDraws; ++i) {
    RandomStream random(6, "test", std::uint64_t(i));
    const Effect push = draw_effect(find_effect("push"), platform, plan.runs, random).at(20);
    EXPECT_EQ(ids.count(push.values.run), 1u);
    pushed.insert(push.values.run);
    EXPECT_LT(value(push, "seconds_into_leg"), platform.side_m / platform.linear_speed_mps);
  }
  EXPECT_GT(pushed.size(), 4u);
}

}  // namespace
}  // namespace umbsim::trial_testing
