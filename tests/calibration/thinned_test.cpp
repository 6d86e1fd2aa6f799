#include "calibration/intake/thinned.h"

#include <gtest/gtest.h>

namespace umbsim::intake {
namespace {

Recording tracked(int readings, double period_s) {
  Recording recording;
  recording.runs.resize(2);
  for (RecordedRun& run : recording.runs) run.encoders.resize(3);
  for (int i = 0; i < readings; ++i) recording.runs[0].truth.push_back({i * period_s, {i * 1.0, 0, 0}});
  recording.runs[1].truth = {{0, {0, 0, 0}}, {0.1, {1, 0, 0}}};
  return recording;
}

std::vector<double> times_s(const Recording& recording) {
  std::vector<double> all;
  for (const TruthSample& t : recording.runs[0].truth) all.push_back(t.time_s);
  return all;
}

TEST(Thinned, KeepsEvenReadingsAndTheLast) {
  const Recording recording = tracked(1002, 0.01);
  const std::vector<double> kept = times_s(thinned_truth(recording, 30));
  ASSERT_EQ(kept.size(), 252u);  // of 100 a second every fourth, and the last one
  for (std::size_t i = 0; i + 1 < kept.size(); ++i) EXPECT_DOUBLE_EQ(kept[i], double(i) * 0.04);
  EXPECT_DOUBLE_EQ(kept.back(), 10.01);
}

TEST(Thinned, LeavesTheRestAsItIs) {
  Recording recording = tracked(1002, 0.01);
  EXPECT_EQ(times_s(thinned_truth(recording, 100)), times_s(recording)) << "just as many as may be";
  EXPECT_EQ(thinned_truth(recording, 30).runs[1].truth.size(), 2u) << "slow enough already";
  EXPECT_EQ(thinned_truth(recording, 30).runs[0].encoders.size(), 3u);
  recording.truth_kind = "endpoints";
  EXPECT_EQ(times_s(thinned_truth(recording, 30)), times_s(recording)) << "end points are no track";
}

TEST(Thinned, CountsAreSums) {
  Recording recording = tracked(2, 1);
  recording.encoder_rate_hz = 1000;
  for (RecordedRun& run : recording.runs) {
    run.encoders.clear();
    for (int i = 0; i < 1006; ++i) run.encoders.push_back({i * 1e-3, 7 * i, 5 * i, 0, 0});
  }
  const Recording kept = thinned_counts(recording, 100);
  EXPECT_DOUBLE_EQ(kept.encoder_rate_hz, 100);
  for (const RecordedRun& run : kept.runs) {
    ASSERT_EQ(run.encoders.size(), 102u) << "every tenth, and the last one";
    EXPECT_EQ(run.encoders[1].left_ticks, 70);
    EXPECT_EQ(run.encoders.back().left_ticks, 7 * 1005) << "none is lost";
    EXPECT_EQ(run.truth.size(), 2u);
  }
  EXPECT_EQ(thinned_counts(recording, 1000).runs[0].encoders.size(), 1006u) << "just as many as may be";
}

}  // namespace
}  // namespace umbsim::intake
