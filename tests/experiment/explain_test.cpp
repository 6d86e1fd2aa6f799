// Which effect causes what: a single one everything, small ones their sum, large ones an interaction of second order.
#include "experiment/explain/explain.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <iostream>

#include "experiment/run.h"
#include "tests/experiment/scenarios.h"

namespace umbsim {
namespace {

using testing::shipped;

const std::string kSmallSquare = "course.side_m=1";

void expect_same(const Contribution& a, const Contribution& b) {
  EXPECT_EQ(a.x_m, b.x_m);
  EXPECT_EQ(a.y_m, b.y_m);
  EXPECT_EQ(a.heading_rad, b.heading_rad);
}

Scenario two_effects(double scale, const std::vector<std::string>& more = {}) {
  std::vector<std::string> settings{kSmallSquare, fmt::format("effects.wheelbase.relative={}", 0.01 * scale),
                                    fmt::format("effects.wheel_radius_difference.relative={}", 0.002 * scale)};
  settings.insert(settings.end(), more.begin(), more.end());
  return shipped("nominal", settings);
}

TEST(Explain, ASingleEffectIsTheWholeRun) {
  const Scenario s = shipped("nominal", {kSmallSquare, "effects.wheelbase.relative=0.01", "truth.position_sd_m=0.002",
                                         "noise.radius_scatter=0.0001", "runs.per_direction=2"});
  const Explanation e = explain(s, 0);
  const ExperimentResult run = run_experiment(s, 0);
  ASSERT_EQ(e.effects.size(), 1u);
  EXPECT_EQ(e.effects[0].name, "wheelbase");
  for (const auto& [direction, cluster] : {std::pair{Direction::cw, run.cw}, std::pair{Direction::ccw, run.ccw}}) {
    expect_same(e.whole.at(direction), {cluster.centroid_x_m, cluster.centroid_y_m, cluster.heading_rad});
    expect_same(e.effects[0].alone.at(direction), e.whole.at(direction) - e.baseline.at(direction));
    expect_same(e.effects[0].missed.at(direction), e.effects[0].alone.at(direction));
    expect_same(e.interaction.at(direction), {});
    EXPECT_GT(e.effects[0].alone.at(direction).distance_m(), 0.01);
  }
}

// Each in its own place: the wheelbase turns both directions alike, the radii in opposite senses.
TEST(Explain, SmallEffectsAddUp) {
  const Explanation whole = explain(two_effects(1), 0), half = explain(two_effects(0.5), 0);
  for (const Direction d : {Direction::cw, Direction::ccw}) {
    const double first = whole.interaction.at(d).distance_m(), second = half.interaction.at(d).distance_m();
    std::cout << fmt::format("{}: whole {:.3f} mm, interaction {:.4f} mm, of half the effects {:.4f} mm\n", name(d),
                             1000 * whole.whole.at(d).distance_m(), 1000 * first, 1000 * second);
    EXPECT_LT(first, 0.05 * whole.whole.at(d).distance_m());
    EXPECT_NEAR(first / second, 4, 0.2) << "of second order";
  }
  const auto heading = [&](int effect, Direction d) {
    return whole.effects[std::size_t(effect)].alone.at(d).heading_rad;
  };
  for (int i = 0; i < 2; ++i) {
    const bool wheelbase = whole.effects[std::size_t(i)].name == "wheelbase";
    const double sign = wheelbase ? -1 : 1, turn = heading(i, Direction::cw);
    EXPECT_NEAR(heading(i, Direction::ccw), sign * turn, 0.01 * std::abs(turn));
  }
}

// The scenario's noise has the same seed with and without an effect, and cancels: far less is left than it scatters.
TEST(Explain, NoiseCancelsInTheDifferences) {
  const std::vector<std::string> noise{"noise.floor_rms_m=0.0005", "noise.radius_scatter=0.0005",
                                       "runs.per_direction=2"};
  const Explanation quiet = explain(two_effects(0.1), 0), noisy = explain(two_effects(0.1, noise), 0);
  for (const Direction d : {Direction::cw, Direction::ccw}) {
    for (std::size_t i = 0; i < 2; ++i) {
      const double left_m = (noisy.effects[i].alone.at(d) - quiet.effects[i].alone.at(d)).distance_m();
      EXPECT_LT(left_m, 0.05 * noisy.baseline.at(d).distance_m());
    }
  }
}

TEST(Explain, WithoutEffectsThereIsOnlyTheBaseline) {
  const Explanation e = explain(shipped("nominal", {kSmallSquare, "runs.directions=[ccw]"}), 0);
  EXPECT_TRUE(e.effects.empty());
  EXPECT_EQ(e.whole.size(), 1u);
  expect_same(e.whole.at(Direction::ccw), e.baseline.at(Direction::ccw));
  expect_same(e.interaction.at(Direction::ccw), {});
}

}  // namespace
}  // namespace umbsim
