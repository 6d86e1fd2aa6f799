#include "gap/trial/score/score.h"

#include <gmock/gmock.h>

#include "core/error.h"
#include "gap/trial/write/seal.h"
#include "tests/gap/trial/fake_simulator.h"

namespace umbsim::trial_testing {
namespace {

using testing::HasSubstr;

std::string diagnosis(const std::string& cause, double probability, const std::string& set,
                      const std::string& more = "") {
  return R"({"format":"umbsim-diagnosis/1","gap":{"detected":true},"causes":[{"effects":{)" + cause +
         R"(},"probability":)" + std::to_string(probability) + R"(}],"set":[)" + set + "]" + more + "}";
}

/// Answers and diagnoses made up by hand.
class HandMade {
 public:
  void add(const std::string& name, const std::string& answer, const std::string& diagnosis_text) {
    answers_ += (answers_.empty() ? "" : ",\n") + ("\"" + name + "\": " + answer);
    cases_ += (cases_.empty() ? "" : ",") + (R"({"name":")" + name + R"(","exclude":[]})");
    folder.write("diagnoses/" + name + "/diagnosis.json", diagnosis_text);
    folder.write("diagnoses/" + name + "/process.json", R"({"exit_code":0,"wall_s":2.5,"failed":false})");
  }
  TrialScore score() {
    folder.write("cases.json", R"({"format":"umbsim-trial-cases/1","trial":"hand","cases":[)" + cases_ + "]}");
    seal_answers(trial(), R"({"format":"umbsim-trial-answers/1","trial":"hand","cases":{)" + answers_ + "}}");
    return score_trial(trial(), trial().answers());
  }
  TrialFolder trial() const { return TrialFolder(folder.path); }
  Folder folder;

 private:
  std::string answers_;
  std::string cases_;
};

const std::string kWheelbaseAnswer =
    R"({"effects":{"wheelbase":{"relative":0.01}},"severities":{"wheelbase":{"severity":3}}})";
const std::string kBump =
    R"({"effects":{"bump":{"height_m":0.006,"x_m":2,"y_m":0}},"severities":{"bump":{"severity":0.7}}})";
const std::string kRightWheelbase = diagnosis(R"("wheelbase":{"relative":{"value":0.011,"ci95":[0.009,0.013]}})", 0.95,
                                              R"("wheelbase")", R"(,"closure":{"held_out_fraction":0.96})");

const Figure& figure(const TrialScore& score, const std::string& key) {
  for (const Figure& f : score.figures) {
    if (f.key == key) return f;
  }
  throw std::out_of_range(key);
}

TEST(Score, CountsWhatWasMadeUp) {
  HandMade trial;
  trial.add("a1", kWheelbaseAnswer, kRightWheelbase);
  trial.add("a2", kWheelbaseAnswer, diagnosis(R"("bump":{})", 0.6, R"("bump","wheelbase","push")"));
  trial.add("a3", kBump, diagnosis(R"("unknown":{})", 0.5, R"("unknown")"));
  trial.add("n1", R"({"effects":{}})", diagnosis(R"("none":{})", 0.9, R"("none")"));
  trial.add("n2", R"({"effects":{}})", diagnosis(R"("wheelbase":{})", 0.7, R"("wheelbase")"));
  trial.add("o1", R"({"effects":{"bump":{}},"excluded":["bump"]})", diagnosis(R"("unknown":{})", 0.9, R"("unknown")"));
  trial.add("p1", R"({"effects":{"bump":{},"wheelbase":{}}})",
            diagnosis(R"("bump":{},"wheelbase":{})", 0.9, R"("bump+wheelbase")"));
  const TrialScore score = trial.score();
  EXPECT_TRUE(score.sealed);
  EXPECT_EQ(score.trial, "hand");

  const auto expect = [&](const char* key, int hits, int cases) {
    EXPECT_EQ(figure(score, key).hits, hits) << key;
    EXPECT_EQ(figure(score, key).cases, cases) << key;
  };
  expect("false_alarm", 1, 2);
  expect("first_cause_right", 1, 3);
  expect("first_cause_right_all", 1, 3);
  expect("truth_in_set", 2, 3);
  expect("known_called_unknown", 1, 3);
  expect("outside_called_unknown", 1, 1);
  expect("pair_both", 1, 1);
  expect("parameter_coverage", 1, 1);
  expect("end_points_right_or_tied", 0, 0);
  EXPECT_EQ(figure(score, "set_size").estimate.value, 1);
  EXPECT_NEAR(figure(score, "parameter_error").estimate.value, 0.1, 1e-9);
  EXPECT_NEAR(figure(score, "closure").estimate.value, 0.96, 1e-9);
  EXPECT_EQ(figure(score, "false_alarm").met, Figure::Met::no);
  EXPECT_EQ(figure(score, "outside_called_unknown").met, Figure::Met::yes);
  EXPECT_EQ(figure(score, "end_points_right_or_tied").met, Figure::Met::no_cases);
  EXPECT_EQ(figure(score, "wall_s").estimate.value, 2.5);
}

TEST(Score, UndetectableCasesAreListedAndNotCounted) {
  HandMade trial;
  trial.add("a1", kWheelbaseAnswer, kRightWheelbase);
  trial.add("u1", R"({"effects":{"floor_slope":{"slope_rad":0.01}},"undetectable_expected":true,
                      "severities":{"floor_slope":{"drawn":2,"severity":0.01,"signal":"x"}}})",
            diagnosis(R"("none":{})", 0.9, R"("none")"));
  const TrialScore score = trial.score();
  EXPECT_EQ(figure(score, "first_cause_right_all").cases, 1);
  EXPECT_THAT(undetected_table(score), HasSubstr("floor_slope"));
  EXPECT_THAT(score_table(score), HasSubstr("u1"));
  EXPECT_EQ(score_json(score).at("verdicts").size(), 2u);
  EXPECT_EQ(by_tier(score.verdicts).at("single").cases, 2);
}

TEST(Score, APairOfWhichOneCannotBeSeenIsNotAskedForBoth) {
  HandMade trial;
  const auto pair = [](const std::string& bump, const std::string& wheelbase) {
    return R"({"effects":{"bump":{},"wheelbase":{}},"severities":{"bump":{"severity":)" + bump +
           R"(},"wheelbase":{"severity":)" + wheelbase + "}}}";
  };
  const std::string half = diagnosis(R"("bump":{})", 0.9, R"("bump")");
  trial.add("p1", pair("3", "0.5"), diagnosis(R"("bump":{},"wheelbase":{})", 0.9, R"("bump+wheelbase")"));
  trial.add("p2", pair("3", "2"), half);
  trial.add("p3", pair("3", "0.49"), half);
  const TrialScore score = trial.score();
  EXPECT_EQ(figure(score, "pair_both").hits, 1);
  EXPECT_EQ(figure(score, "pair_both").cases, 2);
  EXPECT_EQ(figure(score, "pair_both_all").cases, 3);
  EXPECT_EQ(figure(score, "pair_one").hits, 3);
}

TEST(Score, SeverityCalibrationAndConfusion) {
  HandMade trial;
  for (int i = 0; i < 4; ++i) {
    trial.add("a" + std::to_string(i), kWheelbaseAnswer,
              i < 3 ? kRightWheelbase : diagnosis(R"("bump":{})", 0.95, R"("bump")"));
  }
  trial.add("b", kBump, diagnosis(R"("none":{})", 0.31, R"("none")"));
  const TrialScore score = trial.score();
  const std::vector<SeverityBin> bins = by_severity(score.verdicts);
  EXPECT_EQ(bins.at(3).from, 2);
  EXPECT_EQ(bins.at(3).tally.cases, 4);
  EXPECT_EQ(bins.at(3).tally.right, 3);
  EXPECT_EQ(bins.at(1).tally.cases, 1);
  EXPECT_EQ(bins.at(1).tally.detected, 0);
  const std::vector<CalibrationBin> curve = calibration_curve(score.verdicts);
  EXPECT_EQ(curve.at(9).cases, 4);
  EXPECT_EQ(curve.at(9).right, 3);
  EXPECT_NEAR(curve.at(9).mean_probability, 0.95, 1e-9);
  EXPECT_EQ(curve.at(3).cases, 1);
  const Confusion c = confusion(score.verdicts);
  EXPECT_EQ(c.counts.at({"wheelbase", "wheelbase"}), 3);
  EXPECT_EQ(c.counts.at({"wheelbase", "bump"}), 1);
  EXPECT_EQ(c.counts.at({"bump", "none"}), 1);
  const std::string csv = confusion_csv(c);
  EXPECT_EQ(std::size_t(std::count(csv.begin(), csv.end(), '\n')), c.rows.size() + 1);
  EXPECT_THAT(confusion_svg(c, "Trial"), HasSubstr("wheelbase"));
}

TEST(Score, OfForeignRecordings) {
  HandMade trial;  // answers in YAML, no cases.json, no seal, an effect that this catalogue does not know
  const Folder& folder = trial.folder;
  for (const char* name : {"kitchen", "garage"}) folder.write("recordings/" + std::string(name) + "/note", "data");
  folder.write("diagnoses/kitchen/diagnosis.json", kRightWheelbase);
  folder.write("diagnoses/garage/diagnosis.json", diagnosis(R"("unknown":{})", 0.8, R"("unknown")"));
  const fs::path answers = folder.write("mine.yaml",
                                        "format: umbsim-trial-answers/1\ncases:\n  kitchen: {effects: {wheelbase: "
                                        "{relative: 0.01}}}\n  garage: {effects: {magnetic_field: {tesla: 1}}}\n");
  const TrialScore score = score_trial(trial.trial(), answers);
  EXPECT_FALSE(score.sealed);
  EXPECT_THAT(score_table(score), HasSubstr("NOT SEALED"));
  EXPECT_EQ(figure(score, "first_cause_right_all").hits, 1);
  EXPECT_EQ(figure(score, "outside_called_unknown").hits, 1);
  EXPECT_FALSE(score.metadata.has_value());
}

TEST(Score, CasesThatWereNotDiagnosedCountAsFailed) {
  HandMade trial;
  trial.add("a1", kWheelbaseAnswer, kRightWheelbase);
  trial.add("a2", kWheelbaseAnswer, "");
  fs::remove_all(trial.folder.path / "diagnoses/a2");
  const TrialScore score = trial.score();
  EXPECT_EQ(score.verdicts.at(1).named, "failed");
  EXPECT_EQ(figure(score, "first_cause_right_all").cases, 2);
}

TEST(Score, ChangedOrForeignAnswersAreRefused) {
  HandMade trial;
  trial.add("a1", kWheelbaseAnswer, kRightWheelbase);
  trial.score();
  const fs::path answers = trial.trial().answers();
  std::string text = text_of(answers);
  text.replace(text.find("0.01"), 4, "0.02");
  trial.folder.write("answers.json", text);
  EXPECT_THROW(score_trial(trial.trial(), answers), InputError);

  HandMade swapped;  // sealed anew after the diagnosis
  swapped.add("a1", kWheelbaseAnswer, kRightWheelbase);
  swapped.folder.write("diagnoses/a1/process.json",
                       R"({"exit_code":0,"wall_s":1,"failed":false,"answers_sha256":"0123"})");
  EXPECT_THROW(swapped.score(), InputError);
}

TEST(Score, WhatIsMissingIsNamed) {
  HandMade nothing;
  nothing.add("a1", kWheelbaseAnswer, kRightWheelbase);
  fs::remove_all(nothing.folder.path / "diagnoses");
  EXPECT_THROW(nothing.score(), InputError);
  HandMade lacking;
  lacking.add("a1", kWheelbaseAnswer, kRightWheelbase);
  lacking.score();
  const fs::path other =
      lacking.folder.write("other.yaml", "format: umbsim-trial-answers/1\ncases: {b: {effects: {}}}\n");
  fs::remove(lacking.trial().seal());
  EXPECT_THROW(score_trial(lacking.trial(), other), InputError);
}

TEST(Answers, MistakesAreNamed) {
  const Folder folder;
  const auto refused = [&](const std::string& text) {
    try {
      read_answers(folder.write("answers.yaml", text));
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string("was accepted");
  };
  const std::string head = "format: umbsim-trial-answers/1\n";
  EXPECT_THAT(refused("cases: {}\n"), HasSubstr("format"));
  EXPECT_THAT(refused(head), HasSubstr("cases"));
  EXPECT_THAT(refused(head + "cases: {a: {}}\n"), HasSubstr("effects"));
  EXPECT_THAT(refused(head + "cases: {a: {effects: {bump: {height_m: tall}}}}\n"), HasSubstr("height_m"));
  EXPECT_THAT(refused(head + "cases: {a: {effects: {}, tier: third}}\n"), HasSubstr("tier"));
  EXPECT_THAT(refused(head + "cases: {a: {effects: {}, teir: single}}\n"), HasSubstr("teir"));
  EXPECT_THAT(refused(head + "cases: {a: {effects: {}, severities: {bump: {severity: 1}}}}\n"), HasSubstr("bump"));
}

}  // namespace
}  // namespace umbsim::trial_testing
