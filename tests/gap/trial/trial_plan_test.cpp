#include <gmock/gmock.h>

#include "core/error.h"
#include "tests/gap/trial/fake_simulator.h"

namespace umbsim::trial_testing {
namespace {

using testing::HasSubstr;

std::string refusal(const std::string& text) {
  const Folder folder;
  try {
    read_trial(folder.write("t.yaml", text).string());
  } catch (const InputError& e) {
    return e.what();
  }
  return "was accepted";
}

TEST(TrialPlan, WhatIsWrittenOutReadsBackAsTheSame) {
  const Folder folder;
  const TrialPlan plan = read_trial(folder.write("t.yaml",
      "format: umbsim-trial/1\nname: mine\nseed: 9\ncases: {no_effect: 1, single: 2, poor_runs: 3}\n"
      "effects: [bump, push]\nseverity: [1, 5]\ndecoy_exclusions: 0.5\nplatforms: {count: 4, side_m: [2, 3]}\n"
      "noise: {level: [1, 1], radius_scatter: 0}\n"
      "runs:\n  - {id: a, direction: cw}\n  - {id: b, direction: ccw, payload_kg: 3, turn_radius_m: 0.2, "
      "start_heading_rad: -1, speed_factor: 1.5}\n").string());
  EXPECT_EQ(plan.cases.single, 2);
  EXPECT_EQ(plan.effects.size(), 2u);
  EXPECT_EQ(plan.runs.size(), 2u);
  const std::string text = resolved_trial(plan);
  EXPECT_EQ(resolved_trial(read_trial(folder.write("again.yaml", text).string())), text);
}

TEST(TrialPlan, ByDefaultTheWholeCatalogueAndTheRecommendedRuns) {
  const Folder folder;
  const TrialPlan plan =
      read_trial(folder.write("t.yaml", "format: umbsim-trial/1\ncases: {single: 1}\n").string());
  EXPECT_EQ(plan.name, "t");
  EXPECT_EQ(plan.effects.size(), catalogue().size());
  ASSERT_EQ(plan.runs.size(), 12u);
  EXPECT_EQ(plain_runs(plan.runs).size(), 4u);
}

TEST(TrialPlan, ShippedTrialsAreRead) {
  for (const char* name : {"ci", "dev", "published", "small_robots", "large_robots"}) {
    const TrialPlan plan = read_trial(UMBSIM_SOURCE_DIR "/scenarios/trials/" + std::string(name) + ".yaml");
    EXPECT_EQ(plan.name, name);
    EXPECT_FALSE(plan.description.empty());
  }
}

TEST(TrialPlan, ThePublishedTrialIsLargeEnoughAndHasASeedOfItsOwn) {
  const auto shipped = [](const char* name) {
    return read_trial(UMBSIM_SOURCE_DIR "/scenarios/trials/" + std::string(name) + ".yaml");
  };
  const TrialPlan published = shipped("published");
  EXPECT_GE(published.cases.no_effect, 60);
  EXPECT_EQ(published.cases.single, 10 * int(catalogue().size()));
  EXPECT_GE(published.cases.pairs, 30);
  EXPECT_GE(published.cases.outside, 60);
  EXPECT_NE(published.seed, shipped("dev").seed);
  EXPECT_NE(published.seed, shipped("ci").seed);
}

TEST(TrialPlan, MistakesAreNamed) {
  const std::string head = "format: umbsim-trial/1\ncases: {single: 1}\n";
  EXPECT_THAT(refusal("format: umbsim-trial/1\n"), HasSubstr("cases"));
  EXPECT_THAT(refusal("format: umbsim-trial/2\ncases: {}\n"), HasSubstr("umbsim-trial/1"));
  EXPECT_THAT(refusal(head + "sede: 1\n"), HasSubstr("sede"));
  EXPECT_THAT(refusal(head + "severity: [5, 1]\n"), HasSubstr("from = 5 is above to = 1"));
  EXPECT_THAT(refusal(head + "severity: [0, 1]\n"), HasSubstr("t.yaml:3"));
  EXPECT_THAT(refusal(head + "severity: 1\n"), HasSubstr("severity"));
  EXPECT_THAT(refusal(head + "effects: [bmp]\n"), HasSubstr("did you mean 'bump'"));
  EXPECT_THAT(refusal(head + "effects: [bump, bump]\n"), HasSubstr("twice"));
  EXPECT_THAT(refusal(head + "runs: [{id: a, direction: cw}, {id: a, direction: cw}]\n"), HasSubstr("twice"));
  EXPECT_THAT(refusal(head + "runs: [{id: ../a, direction: cw}]\n"), HasSubstr("separator"));
  EXPECT_THAT(refusal(head + "runs: [{id: a, direction: cw, payload_kg: 1}]\n"), HasSubstr("plain"));
  EXPECT_THAT(refusal(head + "noise: {position_sd_m: 0}\n"), HasSubstr("position_sd_m"));
  EXPECT_THAT(refusal("format: umbsim-trial/1\ncases: {pairs: 1}\neffects: [bump]\n"), HasSubstr("two effects"));
  EXPECT_THAT(refusal("format: umbsim-trial/1\ncases: {nul: 1}\n"), HasSubstr("nul"));
}

}  // namespace
}  // namespace umbsim::trial_testing
