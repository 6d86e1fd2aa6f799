#include "gap/trial/score/baselines.h"

#include "tests/gap/trial/fake_simulator.h"

namespace umbsim::trial_testing {
namespace {

/// Plain squares in which the robot ends with these heading errors; a fast run that UMBmark must not look at.
Recording squares(const std::vector<double>& cw_rad, const std::vector<double>& ccw_rad) {
  Recording r;
  r.robot = {"", 0.075, 0.34, 2000};
  r.path.side_m = 1;
  const auto add = [&](const char* direction, double error_rad) {
    RecordedRun run;
    run.id = std::string(direction) + std::to_string(r.runs.size());
    run.direction = direction;
    run.encoders = {{0, 0, 0, 0, 0}, {1, 0, 0, 0, 0}};
    run.truth = {{0, {}}, {1, {0, 0, error_rad}}};
    r.runs.push_back(run);
  };
  for (const double e : cw_rad) add("cw", e);
  for (const double e : ccw_rad) add("ccw", e);
  add("cw", 1);
  r.runs.back().linear_speed_mps = 0.4;
  return r;
}

TEST(UmbmarkAlone, NamesTheTypeThatStandsOut) {
  EXPECT_EQ(umbmark_alone(squares({0.100, 0.101}, {-0.100, -0.101})), "wheelbase");
  EXPECT_EQ(umbmark_alone(squares({0.100, 0.101}, {0.100, 0.101})), "wheel_radius_difference");
  EXPECT_EQ(umbmark_alone(squares({0.100, -0.101}, {0.090, -0.100})), "none");
  EXPECT_EQ(umbmark_alone(squares({0.1}, {0.1})), "none") << "one run has no spread";
}

Verdict verdict(const std::string& effect, const std::string& named) {
  Answer answer;
  answer.tier = effect.empty() ? Tier::no_effect : Tier::single;
  if (!effect.empty()) answer.effects[effect] = {};
  Diagnosis d;
  d.causes.push_back({{named}, {}, 1, 1.0});
  d.causes.push_back({{"push"}, {}, 0, 5.0});
  return judge("x", answer, d, 0);
}

TEST(Baselines, AreCountedOverTheSameCases) {
  const std::vector<Verdict> verdicts{verdict("bump", "bump"), verdict("bump", "wheelbase"), verdict("push", "push"),
                                      verdict("", "none")};
  const std::vector<Baseline> all = baselines(verdicts, {"none", "none", "push", "wheelbase"});
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0].right, 2) << "bump is the commonest";
  EXPECT_EQ(all[0].cases, 3);
  EXPECT_EQ(all[0].false_alarms, 1);
  EXPECT_EQ(all[1].right, 1);
  EXPECT_EQ(all[1].false_alarms, 1);
  EXPECT_EQ(all[2].right, 1) << "the largest drop is always that of push";
}

TEST(Baselines, SayWhyTheyAreNotThere) {
  Verdict v = verdict("bump", "bump");
  for (Cause& cause : v.diagnosis.causes) cause.squared_error_drop.reset();
  const std::vector<Baseline> all = baselines({v}, {});
  EXPECT_FALSE(all[1].note.empty());
  EXPECT_FALSE(all[2].note.empty());
}

}  // namespace
}  // namespace umbsim::trial_testing
