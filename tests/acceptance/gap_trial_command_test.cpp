#include "tests/acceptance/program.h"

namespace umbsim::acceptance {
namespace {

constexpr double kSurely = 0.01;

/// Short drives on one small robot.
const char* kTrial = R"(format: umbsim-trial/1
name: short
description: Short drives
seed: 4
cases: {no_effect: 8, single: 16, outside: 2, end_points: 1, poor_runs: 1}
effects: [wheelbase, wheel_radius_difference, wheel_radius_scale, encoder_resolution, over_acceleration, push, bump, wear]
platforms: {count: 1, side_m: [1, 1], linear_speed_mps: [0.4, 0.4], angular_speed_radps: [1.4, 1.4]}
runs:
  - {id: cw-1, direction: cw}
  - {id: ccw-1, direction: ccw}
  - {id: cw-loaded, direction: cw, payload_kg: 15}
)";

/// A program that stands in for the diagnosis and always says the same.
std::string says(const std::string& cause) {
  return "#!/bin/sh\nmkdir diagnosis && echo "
         "'{\"format\":\"umbsim-diagnosis/1\",\"gap\":{\"detected\":true},\"causes\":"
         "[{\"effects\":{\"" +
         cause + "\":{}},\"probability\":0.5}],\"set\":[\"" + cause + "\"]}' > diagnosis/diagnosis.json\n";
}

std::string script(const Desk& desk, const std::string& cause) {
  const fs::path file = desk.put(cause + ".sh", says(cause));
  fs::permissions(file, fs::perms::owner_all);
  return file.string();
}

TEST(GapTrialCommand, TheThreeStepsOneAfterAnother) {
  const Desk desk;
  desk.put("t.yaml", kTrial);
  const Outcome generated = desk.umbsim({"gap", "trial", "generate", "t.yaml", "--out", "t"});
  ASSERT_EQ(generated.code, 0) << generated.err;
  EXPECT_EQ(generated.err, "");
  const std::string hash = text_of(desk.home / "t/answers.sha256").substr(0, 64);
  expect_says(generated.out, {"28 of 28 cases", hash});
  EXPECT_EQ(desk.shell("cd t && sha256sum --check --quiet answers.sha256").code, 0);
  // Every recording is one for the rest of the program, too.
  const json cases = json_of(desk.home / "t/cases.json").at("cases");
  const std::string first = cases.at(0).at("name");
  EXPECT_EQ(desk.umbsim({"calibrate", "t/recordings/" + first}).code, 0);

  const Outcome diagnosed = desk.umbsim({"gap", "trial", "diagnose", "t", "--program", script(desk, "none")});
  ASSERT_EQ(diagnosed.code, 0) << diagnosed.err;
  expect_says(diagnosed.out, {"28 of 28 cases diagnosed, 0 of them failed"});

  const Outcome scored = desk.umbsim({"gap", "trial", "score", "t"});
  ASSERT_EQ(scored.code, 0) << scored.err;
  expect_says(scored.out, {"sealed before the diagnoses", "false alarm", "UMBmark alone", "guessed from sizes"});
  EXPECT_EQ(listing(desk.home / "t/score"),
            (std::set<std::string>{"confusion.csv", "confusion.svg", "provenance.json", "report.html", "summary.json",
                                   "summary.md", "table.txt"}));
  const json summary = json_of(desk.home / "t/score/summary.json");
  EXPECT_EQ(summary.at("figures").at("false_alarm").at("hits"), 0);
  EXPECT_EQ(summary.at("figures").at("false_alarm").at("cases"), 8);
  EXPECT_EQ(summary.at("figures").at("first_cause_right_all").at("hits"), 0);
  EXPECT_EQ(summary.at("answers_sha256"), hash);
  // Nothing beside ticks and poses tells the effect.
  EXPECT_GT(summary.at("leaks").at("metadata").at("p_value"), kSurely);
  EXPECT_EQ(summary.at("leaks").at("metadata").at("cases"), 26);
}

TEST(GapTrialCommand, TheSameBytesForAnyNumberOfJobsAndShards) {
  const Desk desk;
  desk.put("t.yaml", kTrial);
  const auto generate = [&](const std::string& out, const std::vector<std::string>& more) {
    std::vector<std::string> words{"gap", "trial", "generate", "t.yaml", "--out", out};
    words.insert(words.end(), more.begin(), more.end());
    ASSERT_EQ(desk.umbsim(words).code, 0);
  };
  generate("whole", {"--jobs", "1"});
  generate("parts", {"--shard", "2/2", "--jobs", "3"});
  EXPECT_FALSE(fs::exists(desk.home / "parts/answers.json"));
  generate("parts", {"--shard", "1/2"});
  EXPECT_EQ(files_of(desk.home / "whole"), files_of(desk.home / "parts"));
}

TEST(GapTrialCommand, TheWholeTrialAtOnceAndAgainDoesNothingTwice) {
  const Desk desk;
  std::string trial = kTrial;
  trial.replace(trial.find("no_effect: 8, single: 16"), 24, "no_effect: 1, single: 1");
  desk.put("t.yaml", trial);
  const std::string program = script(desk, "unknown");
  ASSERT_EQ(desk.umbsim({"gap", "trial", "t.yaml", "--program", program}).code, 0);
  EXPECT_TRUE(fs::exists(desk.home / "results/trial-short/score/summary.json"));
  const auto before = files_of(desk.home / "results/trial-short/diagnoses");
  ASSERT_EQ(desk.umbsim({"gap", "trial", "t.yaml", "--program", script(desk, "none")}).code, 0);
  EXPECT_EQ(files_of(desk.home / "results/trial-short/diagnoses"), before);
}

TEST(GapTrialCommand, ChangedAnswersAreRefused) {
  const Desk desk;
  desk.put("t/cases.json", R"({"format":"umbsim-trial-cases/1","trial":"t","cases":[{"name":"a","exclude":[]}]})");
  desk.put("t/answers.json", R"({"format":"umbsim-trial-answers/1","cases":{"a":{"effects":{}}}})");
  desk.put("t/answers.sha256", std::string(64, '0') + "  answers.json\n");
  desk.put(
      "t/diagnoses/a/diagnosis.json",
      R"({"format":"umbsim-diagnosis/1","gap":{"detected":false},"causes":[{"effects":{"none":{}},"probability":1}],"set":["none"]})");
  const Outcome outcome = desk.umbsim({"gap", "trial", "score", "t"});
  EXPECT_EQ(outcome.code, kBadInput);
  expect_says(outcome.err, {"answers.json", "SHA-256", "sealed"});
  fs::remove(desk.home / "t/answers.sha256");
  EXPECT_EQ(desk.umbsim({"gap", "trial", "score", "t"}).code, 0) << "a stranger's answers need no seal";
}

TEST(GapTrialCommand, BadUsageIsNamed) {
  const Desk desk;
  EXPECT_EQ(desk.umbsim({"gap"}).code, kBadInput);
  EXPECT_EQ(desk.umbsim({"gap", "trial"}).code, kBadInput);
  EXPECT_EQ(desk.umbsim({"gap", "trial", "generate"}).code, kBadInput);
  EXPECT_EQ(desk.umbsim({"gap", "trial", "nothing.yaml"}).code, kBadInput);
  EXPECT_EQ(desk.umbsim({"gap", "trial", "score", "nowhere"}).code, kBadInput);
  desk.put("t.yaml", std::string(kTrial) + "sides: 4\n");
  const Outcome outcome = desk.umbsim({"gap", "trial", "generate", "t.yaml"});
  EXPECT_EQ(outcome.code, kBadInput);
  expect_says(outcome.err, {"t.yaml:", "sides"});
  const Outcome help = desk.umbsim({"gap", "trial", "--help"});
  EXPECT_EQ(help.code, 0);
  expect_says(help.out, {"generate", "diagnose", "score"});
}

}  // namespace
}  // namespace umbsim::acceptance
