#include "bench/worlds/world/tracker.h"

#include <gtest/gtest.h>

namespace umbsim::worlds {
namespace {

// A minute along a circle, every 10 ms.
std::vector<TruthSample> seen_circle() {
  std::vector<TruthSample> dense;
  for (int k = 0; k <= 6000; ++k) {
    const double t = 0.01 * k;
    dense.push_back({t, {std::sin(0.2 * t), 1 - std::cos(0.2 * t), 0.2 * t}});
  }
  return dense;
}

Pose2 true_pose(double t) { return {std::sin(0.2 * t), 1 - std::cos(0.2 * t), 0.2 * t}; }

TrackerChoice exact(const std::string& kind) {
  RandomStream random(4, "test tracker");
  TrackerChoice t = draw_tracker(kind, random);
  t.position_sd_m = t.heading_sd_rad = 0;
  return t;
}

// Linear between samples of 10 ms on a circle of 1 m at 0.2 rad/s: 0.01^2 / 8 * 0.04 = 5e-7 m off.
constexpr double kLinear_m = 1e-6;

TEST(Tracker, CameraWithDelayAndDriftLeadsBackToTheTruth) {
  TrackerChoice t = exact("camera");
  t.delay_s = 0.1;
  t.clock_drift = 3e-4;
  const std::vector<TruthSample> seen = observe(seen_circle(), t, RandomStream(1, "t"));
  ASSERT_GT(seen.size(), 400u);
  for (const TruthSample& s : seen) {
    const Pose2 X_WB = inverse(t.X_TW) * s.X_WB * inverse(t.X_BM);
    const Pose2 truth = true_pose((s.time_s - t.delay_s) / (1 + t.clock_drift));
    EXPECT_NEAR(X_WB.x_m, truth.x_m, kLinear_m);
    EXPECT_NEAR(X_WB.y_m, truth.y_m, kLinear_m);
    EXPECT_NEAR(X_WB.theta_rad, truth.theta_rad, 1e-9);
  }
  // After a minute its clock is 18 ms ahead, on top of the delay.
  EXPECT_NEAR(seen.back().time_s, 60 + 0.1 + 0.018, 1 / t.rate_hz);
}

TEST(Tracker, DropoutsAreAStatedShareInStretches) {
  TrackerChoice t = exact("camera");
  t.rate_hz = 20;
  t.dropout = 0.1;
  std::size_t seen = 0, gaps = 0;
  double lost_s = 0;
  for (std::uint64_t k = 0; k < 60; ++k) {
    const std::vector<TruthSample> s = observe(seen_circle(), t, RandomStream(k, "t"));
    seen += s.size();
    for (std::size_t i = 1; i < s.size(); ++i) {
      const double gap_s = s[i].time_s - s[i - 1].time_s;
      if (gap_s < 1.5 / t.rate_hz) continue;
      ++gaps;
      lost_s += gap_s - 1 / t.rate_hz;
    }
  }
  const double share = 1 - double(seen) / (60 * 1201.0);
  EXPECT_NEAR(share, 0.1, 0.01);  // some 1200 stretches: 3 % of the share is one standard deviation
  EXPECT_NEAR(lost_s / double(gaps), t.dropout_s, 0.03);
}

TEST(Tracker, TotalStationSaysNothingOfTheHeading) {
  RandomStream random(4, "test tracker");
  const TrackerChoice t = draw_tracker("total_station", random);
  EXPECT_GE(t.heading_sd_rad, 3);  // the header says that any heading may be
  const std::vector<TruthSample> seen = observe(seen_circle(), t, RandomStream(1, "t"));
  EXPECT_EQ(seen.size(), 301u);  // 5 Hz
  for (const TruthSample& s : seen) EXPECT_EQ(s.X_WB.theta_rad, 0);
}

TEST(Tracker, TapeMeasuresTheEndsAlone) {
  const TrackerChoice t = exact("tape");
  const std::vector<TruthSample> seen = observe(seen_circle(), t, RandomStream(1, "t"));
  ASSERT_EQ(seen.size(), 2u);
  EXPECT_EQ(seen[0].time_s, 0);
  EXPECT_EQ(seen[1].time_s, 60);
}

TEST(Tracker, FrameIsTurnedAndMarkerIsOffTheAxle) {
  TrackerChoice t = exact("mocap");
  t.X_TW = {0.1, -0.2, 0.3};
  t.X_BM = {0.05, 0, 0};
  const std::vector<TruthSample> seen = observe(seen_circle(), t, RandomStream(1, "t"));
  // At the start the robot is at the origin along x; the marker 5 cm ahead, all turned by 0.3 rad.
  EXPECT_NEAR(seen[0].X_WB.x_m, 0.1 + 0.05 * std::cos(0.3), 1e-12);
  EXPECT_NEAR(seen[0].X_WB.y_m, -0.2 + 0.05 * std::sin(0.3), 1e-12);
  EXPECT_NEAR(seen[0].X_WB.theta_rad, 0.3, 1e-12);
}

}  // namespace
}  // namespace umbsim::worlds
