// Counts that move in steps of several are recognised, and how wide the steps are.
#include "recording/coarse_counts.h"

#include <gtest/gtest.h>

#include <cmath>

namespace umbsim {
namespace {

/// A wheel that rolls on, rests and rolls back a little, unevenly, read through steps of `width` counts.
Recording driven(double width, double start = 0) {
  Recording recording;
  recording.robot = {"", 0.06, 0.3, 1000};
  RecordedRun run;
  double angle = start;
  for (int i = 0; i < 3000; ++i) {
    const double speed = i % 500 < 350 ? 9.3 : i % 500 < 420 ? 0 : -4.1;
    angle += speed * (1 + 0.2 * std::sin(0.7 * i * i));
    const auto count = std::int64_t(std::llround(std::round(angle / width) * width));
    run.encoders.push_back({0.02 * i, count, -count, 0, 0});
  }
  recording.runs.push_back(run);
  return recording;
}

TEST(CoarseCounts, FineCountsAreFine) { EXPECT_EQ(count_step(driven(1)), 1); }

// Three counts of a million a turn move the rim by 1 um.
TEST(CoarseCounts, StepsThatNobodySeesAreNone) {
  Recording recording = driven(3.1);
  recording.robot.ticks_per_revolution = 1e6;
  EXPECT_EQ(count_step(recording), 1);
}

TEST(CoarseCounts, TooFewCountsSayNothing) {
  Recording recording = driven(7.3);
  recording.runs[0].encoders.resize(40);
  EXPECT_EQ(count_step(recording), 1);
}

TEST(CoarseCounts, WidthOfTheSteps) {
  for (const double width : {1.1313, 1.2567, 1.8713, 2.0, 2.4147, 3.1, 3.7, 4.43, 5.2, 6.735, 47.47}) {
    // So exact that no step is miscounted over all of them.
    EXPECT_NEAR(count_step(driven(width)), width, 0.25 * width * width / 15000) << width;
  }
}

// A circle whose record begins and ends on the way: no two readings are one step apart.
TEST(CoarseCounts, WheelsThatNeverRestTell) {
  for (const double width : {1.0, 6.735, 16.0, 24.3}) {
    Recording recording;
    RecordedRun run;
    double angle = 0;
    for (int i = 0; i < 1000; ++i) {
      angle += 60 * (1 + 0.2 * std::sin(0.7 * i * i));
      const auto count = std::int64_t(std::llround(std::round(angle / width) * width));
      run.encoders.push_back({0.05 * i, count, count, 0, 0});
    }
    recording.runs.push_back(run);
    EXPECT_NEAR(count_step(recording), width, 0.25 * width * width / 60000) << width;
  }
}

// At constant speed counts come as regularly as steps do, of a wheel that is held to its course, too.
TEST(CoarseCounts, AConstantSpeedIsNoStep) {
  for (const double speed : {33.7, 60.0, 1058.3}) {
    Recording recording;
    RecordedRun run;
    double angle = 0;
    for (int i = 0; i < 1000; ++i) {
      angle += speed * std::min(1.0, 0.1 * i);
      const auto count = std::int64_t(std::llround(angle + 3 * std::sin(0.7 * i * i)));
      run.encoders.push_back({0.05 * i, count, count, 0, 0});
    }
    recording.runs.push_back(run);
    EXPECT_EQ(count_step(recording), 1) << speed;
  }
}

// The same of counters that have been running for long.
TEST(CoarseCounts, WidthOfTheStepsOfAnOldCounter) {
  for (const double width : {1.0, 1.2567, 2.4147, 3.7, 6.735}) {
    EXPECT_NEAR(count_step(driven(width, 1e9 / 7)), width, 0.5 * width * width / 15000) << width;
  }
}

TEST(CoarseCounts, StepsAreCountedFromAnyStart) {
  const Recording recording = driven(6.735, 6.735 * 100);
  const auto& samples = recording.runs[0].encoders;
  const std::vector<double> steps = steps_counted(samples, &EncoderSample::left_ticks, 6.735);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    ASSERT_NEAR((steps[i] - steps[0]) * 6.735, double(samples[i].left_ticks - samples[0].left_ticks), 1) << i;
  }
}

}  // namespace
}  // namespace umbsim
