// The extended figure on made-up squares with known turns by bumps.
#include <gtest/gtest.h>

#include <iostream>

#include "tests/umbmark/exact_kinematics.h"

namespace umbsim {
namespace {

using testing::nominal_odometry;
using testing::square_run;
using testing::squares;
using testing::TrueRobot;

constexpr double kTicks = 1e-8;

Recording with_bumps(const TrueRobot& robot, const std::vector<double>& turns_rad, int count) {
  Recording recording = squares(robot, nominal_odometry());
  for (const double turn_rad : turns_rad) {
    for (const bool cw : {true, false}) {
      RecordedRun run = square_run(robot, nominal_odometry(), cw, 4, turn_rad);
      run.id += "-bumped-" + std::to_string(recording.runs.size());
      run.inner_wheel_bumps = count;
      recording.runs.push_back(run);
    }
  }
  return recording;
}

ExtendedUmbmark measure(const Recording& recording) {
  const Umbmark plain = umbmark(recording, nominal_odometry());
  const auto extended = extended_umbmark(recording, nominal_odometry(), plain);
  EXPECT_TRUE(extended);
  return extended.value_or(ExtendedUmbmark{});
}

// Ten bumps of 0.573 degrees: 5.73 degrees per direction, 11.46 as the sum, whatever the systematic error is.
TEST(ExtendedUmbmark, RemovesTheSystematicOffsetOfEachDirection) {
  for (const TrueRobot& robot : {TrueRobot{}, TrueRobot::with(1.00084, 336.17 / 340), TrueRobot::with(0.99, 1.04)}) {
    const ExtendedUmbmark e = measure(with_bumps(robot, {radians(5.73)}, 10));
    EXPECT_NEAR(degrees(e.cw_mean_abs_heading_error_rad), 5.73, degrees(kTicks));
    EXPECT_NEAR(degrees(e.ccw_mean_abs_heading_error_rad), 5.73, degrees(kTicks));
    EXPECT_NEAR(degrees(e.mean_abs_heading_error_rad), 11.46, degrees(kTicks));
    EXPECT_NEAR(degrees(e.per_bump_heading_error_rad), 0.573, degrees(kTicks));
  }
}

// Lecture 7.5: absolute values, so that +1 and -1 degree do not cancel. And the mean that is taken off is the plain
// runs': with the bumped runs' own mean the first case would measure nothing.
TEST(ExtendedUmbmark, AbsoluteValuesDoNotCancel) {
  const ExtendedUmbmark e = measure(with_bumps(TrueRobot::with(1.002, 1.01), {radians(1), radians(-1)}, 10));
  EXPECT_NEAR(degrees(e.mean_abs_heading_error_rad), 2, degrees(kTicks));
  EXPECT_NEAR(e.cw.heading_rad, measure(with_bumps(TrueRobot::with(1.002, 1.01), {0, 0}, 10)).cw.heading_rad, kTicks);
}

TEST(ExtendedUmbmark, BumpsTurnTowardsTheirWheel) {
  const ExtendedUmbmark e = measure(with_bumps({}, {radians(5)}, 10));
  EXPECT_NEAR(degrees(e.cw.heading_rad), -5, degrees(kTicks)) << "right-hand turns: the right wheel is the inner one";
  EXPECT_NEAR(degrees(e.ccw.heading_rad), 5, degrees(kTicks));
}

TEST(ExtendedUmbmark, BumpedRunsAreNotPlainOnes) {
  const Recording recording = with_bumps({}, {0.1, 0.2}, 10);
  const Umbmark plain = umbmark(recording, nominal_odometry());
  EXPECT_EQ(plain.cw.errors.size(), 1u);
  EXPECT_NEAR(plain.e_max_syst_m, 0, kTicks);
  EXPECT_EQ(return_errors(recording, nominal_odometry(), "cw", true).size(), 2u);
}

TEST(ExtendedUmbmark, NeedsBumpedRunsOfBothDirections) {
  Recording recording = with_bumps({}, {0.1}, 10);
  const Umbmark plain = umbmark(recording, nominal_odometry());
  recording.runs.pop_back();
  EXPECT_FALSE(extended_umbmark(recording, nominal_odometry(), plain));
}

TEST(ExtendedUmbmark, BumpsMayBeListedInsteadOfCounted) {
  Recording recording = with_bumps({}, {0.1}, 10);
  for (RecordedRun& run : recording.runs) {
    if (run.inner_wheel_bumps) run.bumps.assign(4, {1, 0, 0.01});
    run.inner_wheel_bumps.reset();
  }
  EXPECT_NEAR(measure(recording).per_bump_heading_error_rad, 0.1 / 4, kTicks);
}

TEST(ExtendedUmbmark, OfAnUnknownNumberOfBumpsThereIsNoMean) {
  const Recording recording = with_bumps({}, {0.1}, 10);
  const Umbmark plain = umbmark(recording, nominal_odometry());
  const Cluster cw = cluster(return_errors(recording, nominal_odometry(), "cw", true));
  const Cluster ccw = cluster(return_errors(recording, nominal_odometry(), "ccw", true));
  EXPECT_EQ(extended_umbmark(cw, ccw, plain, 0).per_bump_heading_error_rad, 0);
  EXPECT_NEAR(extended_umbmark(cw, ccw, plain, 1).per_bump_heading_error_rad, 0.1, kTicks);
}

}  // namespace
}  // namespace umbsim
