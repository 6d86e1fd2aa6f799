// Which explanation goes first.
#include "gap/answer/ranking.h"

#include <gtest/gtest.h>

#include <numeric>
#include <string>
#include <vector>

#include "tests/gap/subject.h"

namespace umbsim::gap {
namespace {

using testing::campaign;
using testing::effect;
using testing::Subject;

Cause cause_of(const Model& model, const std::vector<std::string>& effects, double score) {
  const Fit fit = testing::fit_of(model, effects);
  return {fit.name(), fit, score, 0};
}

// A wheelbase that is wrong, and what evidence might take for it where engines may differ in turns.
TEST(Ranking, WhatPredictsHeldOutRunsWorseGivesWay) {
  const Subject p(campaign({effect("wheelbase", {{"relative", 0.01}})}, 31));
  const auto first = [&](std::vector<Cause> causes) {
    prefer_what_predicts(p.model, causes, Thresholds{});
    return causes.front().name;
  };
  const auto wheelbase = [&](double score) { return cause_of(p.model, {"wheelbase"}, score); };
  const auto difference = [&](double score) { return cause_of(p.model, {"wheel_radius_difference"}, score); };
  const auto both = [&](double score) { return cause_of(p.model, {"wheelbase", "wheel_radius_difference"}, score); };
  EXPECT_EQ(first({difference(1000), wheelbase(960)}), "wheelbase") << "as many effects, and far better";
  EXPECT_EQ(first({difference(1000), wheelbase(940)}), "wheel_radius_difference") << "it explains much less";
  EXPECT_EQ(first({wheelbase(1000), difference(960)}), "wheelbase") << "as many effects, and worse";
  EXPECT_EQ(first({difference(1000), both(990)}), "wheel_radius_difference") << "more effects never come first by this";
  EXPECT_EQ(first({both(1000), difference(960)}), "wheel_radius_difference+wheelbase") << "fewer, and worse";
}

// However large the odds, a known share of answers is beside the truth: of other engines' recordings the larger one.
TEST(Probabilities, AreNoSurerThanAnswersAre) {
  const auto given = [](std::vector<double> scores, bool elsewhere) {
    std::vector<Cause> causes;
    for (const double score : scores) causes.push_back({"", {}, score, 0});
    give_probabilities(causes, elsewhere);
    std::vector<double> probabilities;
    for (const Cause& c : causes) probabilities.push_back(c.probability);
    EXPECT_NEAR(std::accumulate(probabilities.begin(), probabilities.end(), 0.0), 1, 1e-12);
    return probabilities;
  };
  const std::vector<double> scores{1000, 20, 3, 0};
  const double here = given(scores, false).front(), elsewhere = given(scores, true).front();
  EXPECT_GT(here, 0.97);
  EXPECT_LT(here, 0.99);
  EXPECT_LT(elsewhere, 0.9);
  EXPECT_GT(elsewhere, 0.5);
  EXPECT_EQ(given({0}, true), std::vector<double>{1}) << "nothing else is listed";
  EXPECT_EQ(given({5, 5}, true), (std::vector<double>{0.5, 0.5}));
}

}  // namespace
}  // namespace umbsim::gap
