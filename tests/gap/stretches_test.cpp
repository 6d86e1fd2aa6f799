#include "recording/stretches.h"

#include <gtest/gtest.h>

#include "tests/gap/recordings.h"

namespace umbsim {
namespace {

const RecordedRobot kRobot{"", 0.075, 0.340, 2000};

/// A run from wheel paths alone: pieces of (seconds, v, w), ticks rounded down, no physics.
RecordedRun drawn(const std::vector<std::array<double, 3>>& pieces) {
  constexpr double kPeriod_s = 0.02;
  const double per_m = kRobot.ticks_per_revolution / (2 * M_PI * kRobot.wheel_radius_m);
  RecordedRun run;
  run.id = "drawn";
  double left = 0, right = 0, time = 0;
  run.encoders.push_back({0, 0, 0, 0, 0});
  for (const auto& [seconds, v, w] : pieces) {
    for (int i = 0; i < std::lround(seconds / kPeriod_s); ++i) {
      left += per_m * kPeriod_s * (v - w * kRobot.wheelbase_m / 2);
      right += per_m * kPeriod_s * (v + w * kRobot.wheelbase_m / 2);
      time += kPeriod_s;
      run.encoders.push_back({time, std::int64_t(std::floor(left)), std::int64_t(std::floor(right)), 0, 0});
    }
  }
  return run;
}

std::vector<Stretch> of_kind(const std::vector<Stretch>& all, Stretch::Kind kind) {
  std::vector<Stretch> some;
  for (const Stretch& s : all) {
    if (s.kind == kind) some.push_back(s);
  }
  return some;
}

void expect_whole(const std::vector<Stretch>& all, const RecordedRun& run) {
  ASSERT_FALSE(all.empty());
  EXPECT_EQ(all.front().first, 0u);
  EXPECT_EQ(all.back().last, run.encoders.size() - 1);
  for (std::size_t i = 1; i < all.size(); ++i) EXPECT_EQ(all[i].first, all[i - 1].last) << i;
}

TEST(Stretches, ASimulatedSquareHasFourLegsAndFourTurns) {
  for (const char* turn : {"in_place", "arc"}) {
    SCOPED_TRACE(turn);
    Scenario s = testing::squares(2, 1);
    s.course.turn = turn;
    const Recording recording = run_experiment(s, 0).recording;
    for (const RecordedRun& run : recording.runs) {
      SCOPED_TRACE(run.id);
      const std::vector<Stretch> all = stretches(run, recording.robot);
      expect_whole(all, run);
      const auto legs = of_kind(all, Stretch::Kind::leg), turns = of_kind(all, Stretch::Kind::turn);
      ASSERT_EQ(legs.size(), 4u);
      ASSERT_EQ(turns.size(), 4u);
      const bool arc = s.course.turn == "arc";
      const double leg_m = arc ? s.course.side_m - 2 * s.course.turn_radius_m : s.course.side_m;
      const double angle = run.direction == "cw" ? -M_PI / 2 : M_PI / 2;
      // A border is known to the window over which speeds are taken: 0.1 s of driving or turning, more where the curve
      // begins slowly.
      const double border_m = arc ? 0.1 : 0.005, border_rad = arc ? 0.2 : 0.02;
      for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(legs[i].leg, int(i) + 1);
        EXPECT_EQ(turns[i].leg, int(i) + 1);
        EXPECT_NEAR(legs[i].length_m, leg_m, border_m);
        EXPECT_NEAR(turns[i].angle_rad, angle, border_rad);
        EXPECT_NEAR(turns[i].length_m, arc ? M_PI / 2 * s.course.turn_radius_m : 0, border_m);
      }
    }
  }
}

TEST(Stretches, StandstillsAreFoundThroughTheCountersJitter) {
  RecordedRun run = drawn({{1, 0, 0}, {3, 0.3, 0}, {0.5, 0, 0}, {2, 0, 0.7}, {1, 0, 0}});
  for (std::size_t i = 5; i < 45; i += 3) ++run.encoders[i].left_ticks;  // one tick to and fro while it stands
  const std::vector<Stretch> all = stretches(run, kRobot);
  expect_whole(all, run);
  ASSERT_EQ(all.size(), 5u);
  const Stretch::Kind kinds[] = {Stretch::Kind::still, Stretch::Kind::leg, Stretch::Kind::still, Stretch::Kind::turn,
                                 Stretch::Kind::still};
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(all[i].kind, kinds[i]) << i;
  EXPECT_EQ(all[0].leg, 0);
  EXPECT_NEAR(all[1].length_m, 0.9, 0.001);
  EXPECT_NEAR(all[3].angle_rad, 1.4, 0.01);
  constexpr double kWindow_s = 0.15;
  EXPECT_NEAR(all[1].start_s, 1, kWindow_s);
  EXPECT_NEAR(all[1].end_s, 4, kWindow_s);
}

TEST(Stretches, ACircleIsOneTurn) {
  constexpr double kRadius_m = 0.5, kSpeed_mps = 0.25;
  const double seconds = 2 * M_PI * kRadius_m / kSpeed_mps;
  const RecordedRun run = drawn({{seconds, kSpeed_mps, -kSpeed_mps / kRadius_m}});
  const std::vector<Stretch> all = stretches(run, kRobot);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].kind, Stretch::Kind::turn);
  EXPECT_NEAR(all[0].angle_rad, -2 * M_PI, 0.02);
  EXPECT_NEAR(all[0].length_m, 2 * M_PI * kRadius_m, 0.01);
}

TEST(Stretches, FreeDrivingIsCutWhereTheCurveBegins) {
  const RecordedRun run = drawn({{4, 0.3, 0}, {3, 0.3, 0.6}, {5, 0.3, 0}, {3, 0.3, -0.5}, {4, 0.3, 0.01}});
  const std::vector<Stretch> all = stretches(run, kRobot);
  expect_whole(all, run);
  ASSERT_EQ(all.size(), 5u);
  const double angles[] = {0, 1.8, 0, -1.5, 0.04};
  const double lengths_m[] = {1.2, 0.9, 1.5, 0.9, 1.2};
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(all[i].kind, i % 2 == 0 ? Stretch::Kind::leg : Stretch::Kind::turn) << i;
    EXPECT_NEAR(all[i].angle_rad, angles[i], 0.07) << i;
    EXPECT_NEAR(all[i].length_m, lengths_m[i], 0.05) << i;
  }
  EXPECT_EQ(all[4].leg, 3);
}

TEST(Stretches, NothingIsMadeOfNothing) {
  RecordedRun run;
  EXPECT_TRUE(stretches(run, kRobot).empty());
  run.encoders.push_back({0, 0, 0, 0, 0});
  EXPECT_TRUE(stretches(run, kRobot).empty());
}

}  // namespace
}  // namespace umbsim
