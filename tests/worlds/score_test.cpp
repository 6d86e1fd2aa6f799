// Figures of a few verdicts whose answers can be counted by hand.
#include "bench/worlds/score/score.h"

#include <gtest/gtest.h>

namespace umbsim::worlds {
namespace {

WorldVerdict verdict(const std::string& kind, const std::string& truth, const std::string& named, double unknown = 0) {
  WorldVerdict w;
  w.kind = kind;
  w.unknown = unknown;
  w.verdict.truth = truth;
  w.verdict.named = named;
  w.verdict.detected = named != "none";
  w.verdict.right = truth == named;
  w.verdict.wall_s = double(split(truth).size());
  for (const std::string& effect : split(truth)) {
    if (effect != "none") w.verdict.answer.effects[effect] = {};
  }
  return w;
}

WorldFigures figures_of(const std::vector<WorldVerdict>& verdicts) {
  std::vector<const WorldVerdict*> all;
  for (const WorldVerdict& w : verdicts) all.push_back(&w);
  return world_figures(all);
}

TEST(WorldScore, CountsWhatItSays) {
  std::vector<WorldVerdict> v = {
      verdict("none", "none", "none"),
      verdict("none", "none", "bump"),
      verdict("single", "bump", "bump"),
      verdict("single", "push", "push+wear"),
      verdict("single", "wheelbase", "unknown"),
      verdict("pair", "bump+push", "bump"),
      verdict("triple", "bump+push+wear", "bump+push+wear"),
  };
  v[1].not_there = {2};
  v[3].not_there = {0.2};
  v[2].verdict.diagnosis.closure = 0.9;
  v[3].verdict.diagnosis.closure = 0.5;
  v[4].verdict.distinguishable = false;
  v[4].verdict.both_in_set = v[6].verdict.both_in_set = true;
  v[4].verdict.diagnosis.closure = -0.2;
  v[2].verdict.parameters = {{"bump", "height_m", 0.01, 0.011, 0.1, true}, {"bump", "x_m", 1, 1.1, 0.1, false}};
  v.push_back(verdict("single", "wear", "none"));
  v.back().verdict.answer.undetectable_expected = true;
  v.push_back(verdict("none", "none", "motor_response"));  // a lag that commands show, and hardly a pose
  v.back().not_there = {0.1};
  const WorldFigures f = figures_of(v);
  EXPECT_EQ(f.cases, 9);
  EXPECT_EQ(f.undetectable, 1);
  EXPECT_EQ(f.false_alarm.hits, 2);
  EXPECT_EQ(f.false_alarm.cases, 3);
  EXPECT_EQ(f.pose_alarm.hits, 1);
  EXPECT_EQ(f.pose_alarm.cases, 3);
  EXPECT_EQ(f.right.hits, 1);
  EXPECT_EQ(f.right.cases, 3);
  EXPECT_EQ(f.plain.hits, 1);
  EXPECT_EQ(f.plain.cases, 2);  // these runs mistake the wheelbase for a contact's width
  EXPECT_EQ(f.both.hits, 0);
  EXPECT_EQ(f.both.cases, 1);
  EXPECT_EQ(f.in_set.hits, 2);  // the wheelbase, and the three
  EXPECT_EQ(f.in_set.cases, 5);
  EXPECT_EQ(f.named.hits, 3);  // bump, push beside wear, and the three
  EXPECT_EQ(f.named.cases, 5);
  EXPECT_EQ(f.not_there.hits, 1);  // what is worth a fifth of a noise floor does not count
  EXPECT_EQ(f.only_true.hits, 3);  // bump, bump of the pair, and the three
  EXPECT_EQ(f.only_true.cases, 5);
  EXPECT_EQ(f.untrue.hits, 3);  // in two cases without effect, and wear beside a push
  EXPECT_EQ(f.untrue.cases, 9);
  EXPECT_EQ(f.closed.hits, 1);
  EXPECT_EQ(f.closed.cases, 3);
  EXPECT_DOUBLE_EQ(f.closure.estimate.value, 0.5);
  EXPECT_EQ(f.misled.hits, 1);
  EXPECT_EQ(f.misled.cases, 3);
  EXPECT_EQ(f.covered.hits, 1);
  EXPECT_EQ(f.covered.cases, 2);
  EXPECT_EQ(f.longest_s.estimate.value, 3);
}

// Twenty known effects with leanings 0.00, 0.01, ... 0.19: one of them may be rejected, so what counts as unknown leans
// more than the second of them, 0.18.
TEST(WorldScore, UnknownAtFivePerCentOfTheKnownRejected) {
  std::vector<WorldVerdict> v;
  for (int k = 0; k < 20; ++k) v.push_back(verdict("single", "bump", "bump", 0.01 * k));
  for (const double leaning : {0.9, 0.185, 0.17, 0.0}) v.push_back(verdict("outside", "wind", "unknown", leaning));
  const WorldFigures f = figures_of(v);
  EXPECT_EQ(f.unknown_recall.cases, 4);
  EXPECT_EQ(f.unknown_recall.hits, 2);
  // 20 + 19 + 17.5 + 0.5 of 4 * 20 pairs, a tie counting half.
  EXPECT_NEAR(f.unknown_area.estimate.value, 57.0 / 80, 1e-12);
  EXPECT_LT(f.unknown_area.estimate.low, f.unknown_area.estimate.value);
}

}  // namespace
}  // namespace umbsim::worlds
