// How servos follow their commands is their own, and no effect's: up to what is usual.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "gap/evidence/evidence.h"
#include "recording/counts_behind.h"
#include "tests/gap/subject.h"

namespace umbsim::gap {
namespace {

using testing::campaign;
using testing::effect;
using testing::Subject;

double squared(double x) { return x * x; }

// Squares, in standard deviations, by which no effect misses the counts.
double misfit_of(const Recording& recording, const char* what) {
  const Subject p(recording);
  const double misfit = p.model.counts_misfit(p.model.none());
  std::cout << fmt::format("{}: {:.1f}, {:.0f} rows\n", what, misfit, p.model.count_rows());
  return misfit;
}

// The robot's commands as if its wheels had gone faster by `along` as the cosine of the heading from the start goes and
// by `across` as the sine: of the world's left, or where `mirrored` of the side to which it turns.
Recording faster_by_heading(Recording recording, double along_radps, double across_radps, bool mirrored) {
  for (RecordedRun& run : recording.runs) {
    const double side = mirrored && run.direction == "cw" ? -1 : 1;
    const auto heading = heading_over_time(run, recording.robot);
    const double start_rad = run.truth.front().X_WB.theta_rad;
    const Eigen::Vector2d ahead(std::cos(start_rad), std::sin(start_rad)), aside(-ahead[1], ahead[0]);
    for (std::size_t i = 1; i < run.encoders.size(); ++i) {
      EncoderSample& s = run.encoders[i];
      const Eigen::Vector2d way =
          (heading[i].ahead_s - heading[i - 1].ahead_s) / (s.time_s - run.encoders[i - 1].time_s);
      const double faster = along_radps * way.dot(ahead) + side * across_radps * way.dot(aside);
      s.left_command_radps -= faster;
      s.right_command_radps -= faster;
    }
  }
  return recording;
}

// One lag of all runs is one surprise, not one for each run.
TEST(Servos, ThatLagAreOneSurprise) {
  constexpr double kLag_s = 0.03;
  const Subject p(campaign({effect("motor_response", {{"lag_s", kLag_s}})}, 56));
  const double once = p.model.counts_misfit(p.model.none());
  const double prior = squared(kLag_s) / (squared(Scatter{}.lag_s) + squared(Scatter{}.servo_s));
  std::cout << fmt::format("squares: {:.1f}; {:.1f} of the lag, {:.0f} rows\n", once, prior, p.model.count_rows());
  EXPECT_GT(once, 0.8 * prior);
  EXPECT_LT(once, prior + p.model.count_rows());
}

// A servo without an integral part gives way under its load, each wheel by its own.
TEST(Servos, ThatGiveWayAsManyDoAreOneSurprise) {
  const Subject robot(campaign({}, 57));
  const double droop = Scatter{}.servo_s / robot.model.motor_inertia_kgm2();
  const double plain = misfit_of(robot.recording, "no effect");
  const double gives_way =
      misfit_of(campaign({effect("motor_response", {{"droop_radps_per_nm", droop}})}, 57), "a servo of 20 ms");
  EXPECT_LT(gives_way, plain + 4) << "one standard deviation, and the noise of another drive";
}

// What a driver does along its course is mirrored from cw to ccw; a slope is the world's.
TEST(Servos, ThatGoWithTheCourseAreNoSlope) {
  const Recording recording = campaign({}, 58);
  const double speed_radps = recording.path.linear_speed_mps.value() / recording.robot.wheel_radius_m;
  const double usual = 0.5 * Scatter{}.course_gain * speed_radps;
  const double plain = misfit_of(recording, "no effect");
  EXPECT_LT(misfit_of(faster_by_heading(recording, usual, usual, true), "along the course"), plain + 4);
  EXPECT_GT(misfit_of(faster_by_heading(recording, 0, usual, false), "across, by the world"), plain + 20);
}

// Friction in turns in place holds wheels back there, and is read neither from the way nor as a slope.
TEST(Servos, ThatAreHeldBackInTurnsAreNoSlope) {
  constexpr double kBehind_radps = 0.03;
  const Recording recording = campaign({}, 60);
  const RecordedRobot& robot = recording.robot;
  for (const RecordedRun& run : recording.runs) {
    if (run.turn_radius_m) continue;
    std::vector<std::array<double, 2>> angles{{0, 0}};
    for (std::size_t i = 1; i < run.encoders.size(); ++i) {
      const EncoderSample& s = run.encoders[i];
      const double dt_s = s.time_s - run.encoders[i - 1].time_s;
      const std::array<double, 2> told{s.left_command_radps, s.right_command_radps};
      angles.push_back(angles.back());
      for (std::size_t w = 0; w < 2; ++w) {
        const double behind = told[0] * told[1] < 0 ? std::copysign(kBehind_radps, told[w]) : 0;
        angles.back()[w] += (told[w] - behind) * dt_s;
      }
    }
    const CommandResponse r = command_response(run, robot, angles, 2 * M_PI / robot.ticks_per_revolution);
    std::cout << fmt::format("{}: behind by {:.5f} and {:.5f}, along {:.5f} and {:.5f} rad/s\n", run.id,
                             r.behind_radps[0], r.behind_radps[1], r.by_heading_radps[0], r.by_heading_radps[1]);
    // In the ramps of a turn a speed goes with no angle: for each wheel the heading takes a tenth, and gives it back in
    // the mean of both.
    EXPECT_NEAR(r.behind_radps[1], kBehind_radps, 0.15 * kBehind_radps);
    EXPECT_NEAR(r.behind_radps[0], 0, 0.01 * kBehind_radps);
    EXPECT_LT(r.by_heading_radps.norm(), 0.01 * kBehind_radps);
  }
}

TEST(Servos, ThatAreSlowerThanAnyAreNamed) {
  const Subject p(campaign({effect("motor_response", {{"lag_s", 0.15}})}, 59));
  const Diagnosis d = p.diagnosed();
  EXPECT_EQ(d.causes.front().name, "motor_response") << d.causes.front().probability;
}

}  // namespace
}  // namespace umbsim::gap
