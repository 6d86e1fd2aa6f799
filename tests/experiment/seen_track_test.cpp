// Where a tracker saw a robot beside its replay: what a clock and an offset of the tracked point do is no way off.
#include "experiment/replay/seen_track.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "core/random.h"

namespace umbsim {
namespace {

constexpr double kRate_hz = 50;
constexpr double kSeenLeg_s = 10;
constexpr double kSeenTurn_s = 2.5;
constexpr double kSpeed_mps = 0.2;

// A square driven from the origin, at any time.
Pose2 square_at(double time_s) {
  Pose2 pose;
  double left_s = std::max(0.0, time_s);
  for (int leg = 0; leg < 4 && left_s > 0; ++leg) {
    const double on_leg = std::min(left_s, kSeenLeg_s);
    pose = pose * Pose2{kSpeed_mps * on_leg, 0, 0};
    left_s -= on_leg;
    const double turning = std::min(left_s, kSeenTurn_s);
    pose = pose * Pose2{0, 0, M_PI / 2 * turning / kSeenTurn_s};
    left_s -= turning;
  }
  return pose;
}

// A circle of about 1.5 m, as a driver holds it, from a standstill at any time.
Pose2 circle_at(double time_s) {
  constexpr double kRadius_m = 1.5, kWobble_m = 0.004, kStill_s = 1, kDriven_s = 40;
  const double angle_rad = kSpeed_mps / kRadius_m * std::clamp(time_s - kStill_s, 0.0, kDriven_s);
  const double radius_m = kRadius_m + kWobble_m * std::sin(2 * angle_rad);
  const double outward = 2 * kWobble_m * std::cos(2 * angle_rad) / radius_m;
  return {radius_m * std::sin(angle_rad), kRadius_m - radius_m * std::cos(angle_rad), angle_rad - outward};
}

struct Seen {
  Pose2 (*course)(double) = square_at;
  double ahead_s = 0;
  Pose2 point;        // of the tracked point on the robot
  Pose2 drift_per_s;  // of the robot from its replay, in the replay's frame
  double noise_m = 0.0003;
};

// Largest distance and angle between where the robot was and where it is said to have been, over all moments.
std::pair<double, double> largest_error(const Seen& how) {
  RecordedRun run;
  std::vector<Pose2> track;
  RandomStream random(1, "tracker");
  const auto robot_at = [&](double t) {
    return Pose2{how.drift_per_s.x_m * t, how.drift_per_s.y_m * t, how.drift_per_s.theta_rad * t} * how.course(t);
  };
  for (int i = 0; i / kRate_hz < 4 * (kSeenLeg_s + kSeenTurn_s); ++i) {
    EncoderSample s;
    s.time_s = i / kRate_hz;
    run.encoders.push_back(s);
    track.push_back(how.course(s.time_s));
    const Pose2 seen = robot_at(s.time_s + how.ahead_s) * how.point;
    run.truth.push_back({s.time_s,
                         {seen.x_m + how.noise_m * random.normal(), seen.y_m + how.noise_m * random.normal(),
                          seen.theta_rad + how.noise_m * random.normal()}});
  }
  const std::vector<Pose2> beside = seen_beside(run, track, 10);
  EXPECT_EQ(beside.size(), (track.size() + 9) / 10);
  double most_m = 0, most_rad = 0;
  for (std::size_t i = 0; i < beside.size(); ++i) {
    const Pose2 said = beside[i] * track[10 * i], is = robot_at(run.encoders[10 * i].time_s);
    most_m = std::max(most_m, std::hypot(said.x_m - is.x_m, said.y_m - is.y_m));
    most_rad = std::max(most_rad, std::abs(said.theta_rad - is.theta_rad));
  }
  std::cout << fmt::format("off by at most {:.2f} mm, {:.2f} mrad\n", 1000 * most_m, 1000 * most_rad);
  return {most_m, most_rad};
}

TEST(SeenTrack, FollowsARobotThatDriftsFromItsReplay) {
  Seen how;
  how.drift_per_s = {1e-4, -1e-4, 1e-4};  // 7 mm and 5 mrad in the end
  const auto [m, rad] = largest_error(how);
  EXPECT_LT(m, 0.001);
  EXPECT_LT(rad, 0.0005);
}

TEST(SeenTrack, IsNotMovedByTheTrackersClockOrPoint) {
  Seen how;
  how.drift_per_s = {1e-4, -1e-4, 1e-4};
  how.ahead_s = 0.02;  // 4 mm on a leg, 13 mrad in a turn
  how.point = {0.01, -0.02, 0};
  const auto [m, rad] = largest_error(how);
  EXPECT_LT(m, 0.001);
  EXPECT_LT(rad, 0.0005);
}

// A point beside the axle's middle and a wrong scale look alike there: neither may grow to explain a lateral slip.
TEST(SeenTrack, FollowsARobotOnACircle) {
  Seen how;
  how.course = circle_at;
  how.drift_per_s = {3e-4, 3e-4, 2e-4};  // 17 mm and 8 mrad in the end
  how.point = {-0.003, 0.003, 0};
  const auto [m, rad] = largest_error(how);
  EXPECT_LT(m, 0.005);
  EXPECT_LT(rad, 0.0005);
}

// Nothing is known of clock and point then; the way off is seen all the same.
TEST(SeenTrack, FollowsARobotThatNeverGoesSteadily) {
  RecordedRun run;
  std::vector<Pose2> track;
  for (int i = 0; i < 1000; ++i) {
    const double t = i / kRate_hz;
    EncoderSample s;
    s.time_s = t;
    run.encoders.push_back(s);
    track.push_back({0.1 * t * t, 0, 0.5 * std::sin(6 * t)});
    run.truth.push_back({t, {track.back().x_m, 0.002, track.back().theta_rad}});
  }
  const std::vector<Pose2> beside = seen_beside(run, track, 10);
  ASSERT_EQ(beside.size(), 100u);
  for (std::size_t i = 0; i < beside.size(); ++i) EXPECT_NEAR((beside[i] * track[10 * i]).y_m, 0.002, 1e-9);
}

TEST(SeenTrack, SaysNothingOfEndPoints) {
  RecordedRun run;
  run.encoders = {{}, {}};
  run.encoders[1].time_s = 1;
  run.truth = {{0, {}}, {1, {}}};
  EXPECT_TRUE(seen_beside(run, {{}, {}}, 10).empty());
}

}  // namespace
}  // namespace umbsim
