#include "calibration/prediction.h"

#include <gtest/gtest.h>

namespace umbsim::calibration {
namespace {

std::vector<Pose2> figure() {
  std::vector<Pose2> track{{0.2, 0.1, 0.3}};
  for (int k = 1; k < 100; ++k) track.push_back(track.back() * arc(0.05, k < 50 ? 0.06 : -0.05));
  return track;
}

RecordedRun recorded(const std::vector<Pose2>& track) {
  RecordedRun run;
  for (std::size_t k = 0; k < track.size(); ++k) run.truth.push_back({0.1 * double(k), track[k]});
  return run;
}

TEST(PredictionError, AFrameThatIsTurnedAndMovedCostsNothing) {
  const std::vector<Pose2> truth = figure();
  std::vector<Pose2> predicted;
  const Pose2 frame{0.3, -0.2, radians(0.4)};
  for (const Pose2& p : truth) predicted.push_back(inverse(frame) * p);
  const RunError e = prediction_error(recorded(truth), predicted);
  EXPECT_NEAR(e.final_mm, 0, 1e-9);
  EXPECT_NEAR(e.along_mm, 0, 1e-9);
  EXPECT_NEAR(e.frame_deg, 0.4, 1e-9);
  EXPECT_NEAR(e.raw_final_mm,
              1000 * std::hypot(truth.back().x_m - predicted.back().x_m, truth.back().y_m - predicted.back().y_m),
              1e-9);
}

// Two points that part by d: the best motion leaves half of it at each end.
TEST(PredictionError, AStretchedLineErrsAtItsEnds) {
  std::vector<Pose2> truth, predicted;
  for (int k = 0; k <= 10; ++k) {
    truth.push_back({0.1 * k, 0, 0});
    predicted.push_back({0.102 * k, 0, 0});
  }
  const RunError e = prediction_error(recorded(truth), predicted);
  EXPECT_NEAR(e.raw_final_mm, 20, 1e-9);
  EXPECT_NEAR(e.final_mm, 10, 1e-9);
  // Root mean square of -10, -8 ... 10 mm.
  EXPECT_NEAR(e.along_mm, std::sqrt(40.0), 1e-9);
}

TEST(Reckoned, IsDeadReckoningAtTheTimesOfTheTruth) {
  const OdometryParameters odometry{0.05, 0.05, 0.3, 2 * M_PI * 0.05 * 1e4};  // a tick is 0.1 mm
  Recording recording;
  recording.runs.emplace_back();
  RecordedRun& run = recording.runs[0];
  for (int i = 0; i <= 100; ++i) run.encoders.push_back({0.02 * i, 100 * i, 100 * i, 0, 0});
  const Pose2 start{1, 2, M_PI / 2};
  for (const double t : {0.0, 0.5, 0.51, 2.0}) run.truth.push_back({t, start});
  const Prediction p = reckoned("odometry", recording, odometry);
  ASSERT_EQ(p.tracks[0].size(), 4u);
  const double ways_m[] = {0, 0.25, 0.255, 1};
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(p.tracks[0][k].x_m, 1, 1e-12);
    EXPECT_NEAR(p.tracks[0][k].y_m, 2 + ways_m[k], 1e-12);
  }
}

}  // namespace
}  // namespace umbsim::calibration
