#include "gap/trial/score/verdict.h"

#include <gmock/gmock.h>

#include <cmath>

#include "core/error.h"
#include "tests/gap/trial/fake_simulator.h"

namespace umbsim::trial_testing {
namespace {

Answer truth(const std::map<std::string, TrueEffect>& effects, Tier tier) {
  Answer answer;
  answer.effects = effects;
  answer.tier = tier;
  return answer;
}

Diagnosis names(const EffectNames& first, const std::vector<EffectNames>& set) {
  Diagnosis d;
  d.detected = !first.count("none");
  d.causes.push_back({first, {}, 0.8, {}});
  d.set = set;
  return d;
}

const Answer kWheelbase = truth({{"wheelbase", {{{"relative", 0.01}}, "", 3.0}}}, Tier::single);
const Answer kPair = truth({{"bump", {}}, {"wheelbase", {}}}, Tier::pairs);
const Answer kNone = truth({}, Tier::no_effect);

TEST(Verdict, TheFirstCauseIsRightOrWrong) {
  EXPECT_TRUE(judge("a", kWheelbase, names({"wheelbase"}, {{"wheelbase"}}), 1).right);
  const Verdict wrong = judge("a", kWheelbase, names({"bump"}, {{"bump"}, {"wheelbase"}}), 1);
  EXPECT_FALSE(wrong.right);
  EXPECT_FALSE(wrong.right_or_tied);
  EXPECT_TRUE(wrong.in_set);
  EXPECT_TRUE(wrong.distinguishable);
  EXPECT_EQ(wrong.named, "bump");
}

TEST(Verdict, ATieThatTheDiagnosisItselfPredictsIsForgivenButNotCountedAsRight) {
  Diagnosis d = names({"contact_patch"}, {{"contact_patch"}});
  d.indistinguishable = {{"wheelbase", "contact_patch"}, {"bump", "push"}};
  const Verdict v = judge("a", kWheelbase, d, 1);
  EXPECT_FALSE(v.right);
  EXPECT_TRUE(v.right_or_tied);
  EXPECT_FALSE(v.distinguishable);
  d.indistinguishable = {{"contact_patch", "bump"}};
  EXPECT_FALSE(judge("a", kWheelbase, d, 1).right_or_tied);
}

TEST(Verdict, WhatTheDiagnosisHadToDoWithoutIsNoRival) {
  Answer answer = kWheelbase;
  answer.excluded = {"contact_patch"};
  Diagnosis d = names({"wheelbase"}, {{"wheelbase"}});
  d.indistinguishable = {{"wheelbase", "contact_patch"}};
  EXPECT_TRUE(judge("a", answer, d, 1).distinguishable);
  d.indistinguishable = {{"wheelbase", "contact_patch", "fast_turning"}};
  EXPECT_FALSE(judge("a", answer, d, 1).distinguishable);
}

TEST(Verdict, NoEffectIsRightAsNone) {
  EXPECT_TRUE(judge("a", kNone, names({"none"}, {{"none"}}), 1).right);
  EXPECT_FALSE(judge("a", kNone, names({"none"}, {{"none"}}), 1).detected);
  EXPECT_TRUE(judge("a", kNone, names({"bump"}, {{"bump"}}), 1).detected);
  EXPECT_TRUE(judge("a", kNone, names({"unknown"}, {{"unknown"}}), 1).detected);
}

TEST(Verdict, OutsideTheCatalogueUnknownIsRight) {
  const Answer outside = truth({{"bump", {}}}, Tier::outside);
  EXPECT_TRUE(judge("a", outside, names({"unknown"}, {{"unknown"}}), 1).right);
  EXPECT_TRUE(judge("a", outside, names({"push"}, {{"push"}, {"unknown"}}), 1).in_set);
  Diagnosis d = names({"push"}, {{"push"}});
  EXPECT_FALSE(judge("a", outside, d, 1).right_or_tied);
  d.indistinguishable = {{"bump", "push"}};
  EXPECT_TRUE(judge("a", outside, d, 1).right_or_tied);
}

TEST(Verdict, TwoEffectsAreRightTogether) {
  EXPECT_TRUE(judge("a", kPair, names({"bump", "wheelbase"}, {{"bump", "wheelbase"}}), 1).right);
  const Verdict half = judge("a", kPair, names({"bump"}, {{"bump"}}), 1);
  EXPECT_FALSE(half.right);
  EXPECT_FALSE(half.both_in_set);
  EXPECT_TRUE(half.one_in_set);
  // A member with a third effect has both; two members with one each do not.
  EXPECT_TRUE(judge("a", kPair, names({"bump"}, {{"bump", "push", "wheelbase"}}), 1).both_in_set);
  EXPECT_FALSE(judge("a", kPair, names({"bump"}, {{"bump"}, {"wheelbase"}}), 1).both_in_set);
  Diagnosis tied = names({"push", "wheelbase"}, {});
  tied.indistinguishable = {{"bump", "push"}};
  EXPECT_TRUE(judge("a", kPair, tied, 1).right_or_tied);
}

TEST(Verdict, AFailedProcessIsWrongEverywhere) {
  const Verdict v = judge("a", kWheelbase, std::nullopt, 1);
  EXPECT_EQ(v.named, "failed");
  EXPECT_FALSE(v.right || v.right_or_tied || v.in_set || v.unknown || v.detected || *v.stage_right);
  EXPECT_TRUE(judge("a", kNone, std::nullopt, 1).detected) << "counts as a false alarm";
}

TEST(Verdict, StageAndPattern) {
  Diagnosis d = names({"wheelbase"}, {});
  d.stage = "geometry";
  d.pattern = "turns";
  Verdict v = judge("a", kWheelbase, d, 1);
  EXPECT_TRUE(*v.stage_right);
  EXPECT_TRUE(*v.location_right);
  d.stage = "contact";
  d.pattern = "legs";
  v = judge("a", kWheelbase, d, 1);
  EXPECT_FALSE(*v.stage_right);
  EXPECT_FALSE(*v.location_right);
  EXPECT_FALSE(judge("a", truth({{"tyre_compliance", {}}}, Tier::single), d, 1).location_right.has_value());
  EXPECT_FALSE(judge("a", kPair, d, 1).stage_right.has_value());
}

TEST(Verdict, APlaceIsRightWithinTenCentimetresOfTheEdge) {
  const Answer bump = truth({{"bump", {{{"x_m", 2}, {"y_m", -0.17}, {"height_m", 0.006}}, "", {}}}}, Tier::single);
  const Answer patch =
      truth({{"slippery_patch", {{{"x_m", 2}, {"y_m", -0.17}, {"radius_m", 0.3}}, "", {}}}}, Tier::single);
  Diagnosis d = names({"bump"}, {});
  EXPECT_FALSE(*judge("a", bump, d, 1).location_right) << "no place is given";
  d.place_m = {2.09, -0.17};
  EXPECT_TRUE(*judge("a", bump, d, 1).location_right);
  d.place_m = {2.3, -0.17};
  EXPECT_FALSE(*judge("a", bump, d, 1).location_right);
  EXPECT_TRUE(*judge("a", patch, d, 1).location_right);
}

TEST(Verdict, APushIsRightWithItsRunAndLegFirst) {
  const Answer push = truth({{"push", {{{"leg", 2}, {"impulse_newton_seconds", 30}}, "ccw-1", {}}}}, Tier::single);
  Diagnosis d = names({"push"}, {});
  d.segments = {{"ccw-1", 2}, {"cw-1", 1}};
  EXPECT_TRUE(*judge("a", push, d, 1).location_right);
  d.segments = {{"cw-1", 1}, {"ccw-1", 2}};
  EXPECT_FALSE(*judge("a", push, d, 1).location_right);
}

TEST(Verdict, ParametersAreComparedWhereTheCauseIsRight) {
  Diagnosis d = names({"wheelbase"}, {});
  d.causes.front().parameters["wheelbase"]["relative"] = {0.012, 0.011, 0.013};
  const Verdict v = judge("a", kWheelbase, d, 1);
  ASSERT_EQ(v.parameters.size(), 1u);
  EXPECT_NEAR(v.parameters[0].relative_error, 0.2, 1e-12);
  EXPECT_FALSE(v.parameters[0].covered);
  d.causes.front().parameters["wheelbase"]["relative"].low = 0.009;
  EXPECT_TRUE(judge("a", kWheelbase, d, 1).parameters[0].covered);
  d.causes.front().effects = {"bump"};
  EXPECT_TRUE(judge("a", kWheelbase, d, 1).parameters.empty());
}

TEST(Verdict, AParameterCountsFromItsNeutralValueAndWhatIsNotReportedAsNeutral) {
  const Answer turning = truth({{"fast_turning", {{{"factor", 3}}, "", {}}}}, Tier::single);
  Diagnosis d = names({"fast_turning"}, {});
  d.causes.front().parameters["fast_turning"]["factor"] = {2, 1, 4};
  EXPECT_NEAR(judge("a", turning, d, 1).parameters.at(0).relative_error, 0.5, 1e-12);  // neutral: 1
  d.causes.front().parameters.clear();
  const Verdict silent = judge("a", turning, d, 1);
  EXPECT_NEAR(silent.parameters.at(0).relative_error, 1, 1e-12);
  EXPECT_FALSE(silent.parameters.at(0).covered);
}

TEST(DiagnosisFile, IsReadWithNullsForTheInfinite) {
  const Folder folder;
  const Diagnosis d = read_diagnosis(folder.write("d.json", R"({"format": "umbsim-diagnosis/1",
    "gap": {"detected": true, "p_value": 0.001},
    "where": {"stage": "floor", "pattern": "place", "segments": [{"run": "cw-1", "leg": 2, "part": "cruise", "score": 9}],
              "place_m": [1.5, -0.2]},
    "causes": [{"effects": {"bump": {"height_m": {"value": 0.006, "ci95": [0.005, null]}, "run": "all"},
                            "push": {"leg": 2}}, "probability": 0.9, "squared_error_drop": 12}],
    "set": ["bump+push", "unknown"], "indistinguishable": [["carpet_drift", "floor_slope"]],
    "closure": {"held_out_fraction": 0.97}, "more": 1})"));
  EXPECT_EQ(d.causes.at(0).effects, (EffectNames{"bump", "push"}));
  EXPECT_EQ(d.causes.at(0).parameters.at("bump").at("height_m").low, 0.005);
  EXPECT_TRUE(std::isinf(d.causes.at(0).parameters.at("bump").at("height_m").high));
  EXPECT_EQ(d.causes.at(0).parameters.at("push").at("leg").value, 2);
  EXPECT_EQ(d.set, (std::vector<EffectNames>{{"bump", "push"}, {"unknown"}}));
  EXPECT_EQ(d.segments.at(0).run, "cw-1");
  EXPECT_EQ(d.place_m->first, 1.5);
  EXPECT_EQ(*d.closure, 0.97);
  EXPECT_EQ(*d.causes.at(0).squared_error_drop, 12);
}

TEST(DiagnosisFile, WhatIsNoneIsRefusedByName) {
  const Folder folder;
  for (const char* text : {"", "{}", "[]", R"({"format": "umbsim-result/1"})",
                           R"({"format":"umbsim-diagnosis/1","gap":{"detected":true},"causes":[],"set":[]})"}) {
    try {
      read_diagnosis(folder.write("d.json", text));
      ADD_FAILURE() << text;
    } catch (const InputError& e) {
      EXPECT_THAT(e.what(), testing::HasSubstr("d.json"));
    }
  }
}

}  // namespace
}  // namespace umbsim::trial_testing
