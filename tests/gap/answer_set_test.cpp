#include "gap/answer/answer_set.h"

#include <gmock/gmock.h>

namespace umbsim::gap {
namespace {

using testing::ElementsAre;

Fit fit_of(const std::vector<std::string>& effects, double log_evidence) {
  Fit fit;
  for (const std::string& effect : effects) {
    for (Hypothesis& f : plain_hypotheses(0.02, 2000)) {
      if (f.effect != effect) continue;
      fit.hypotheses.push_back(std::move(f));
      break;
    }
  }
  std::size_t numbers = 0;
  for (const Hypothesis& f : fit.hypotheses) numbers += f.parameters.size();
  fit.p = Eigen::VectorXd::Zero(Eigen::Index(numbers));
  fit.log_evidence = log_evidence;
  return fit;
}

Diagnosis named(const Fit& fit) {
  Diagnosis d;
  const std::string name = fit.hypotheses.empty() ? "none" : fit.name();
  d.causes.push_back({name, fit, 0, 0});
  d.set = {name};
  return d;
}

TEST(AnswerSet, WhatIsTooSmallStandsBesideNone) {
  const Fit none = fit_of({}, 100);
  Diagnosis d = named(none);
  add_doubtful({fit_of({"wear"}, 102), fit_of({"wheelbase", "wear"}, 140)}, none, d);
  EXPECT_THAT(d.set, ElementsAre("none")) << "little evidence, and two at once";
  add_doubtful({fit_of({"wear"}, 104), fit_of({"wheelbase"}, 106)}, none, d);
  EXPECT_THAT(d.set, ElementsAre("none", "wheelbase"));
}

TEST(AnswerSet, WhatShowsMostStandsBesideNoneAlone) {
  const Thresholds t;
  Diagnosis d = named(fit_of({}, 100));
  add_faint({{"backlash", 2 * t.faint}}, t, d);
  EXPECT_THAT(d.set, ElementsAre("none")) << "too much of what chance does, too";
  add_faint({{"backlash", 0.04}, {"wear", 0.005}, {"wheelbase", 0.001}, {"wheel_radius_scale", 0.02}}, t, d);
  EXPECT_THAT(d.set, ElementsAre("none", "wheelbase", "wear")) << "the likeliest, and what is hardly less so";
  add_faint({{"tyre_creep", 1e-9}}, t, d);
  EXPECT_THAT(d.set, ElementsAre("none", "wheelbase", "wear")) << "not beside anything else";
  Diagnosis many = named(fit_of({}, 100));
  add_faint({{"backlash", 0.003}, {"wear", 0.001}, {"wheelbase", 0.002}}, t, many);
  EXPECT_THAT(many.set, ElementsAre("none", "wear", "wheelbase")) << "no more than two";
  Diagnosis found = named(fit_of({"wear"}, 100));
  add_faint({{"wheelbase", 0.001}}, t, found);
  EXPECT_THAT(found.set, ElementsAre("wear"));
}

TEST(AnswerSet, OneEffectMoreStandsBesideTheFirstCause) {
  const Fit none = fit_of({}, 100);
  Diagnosis d = named(fit_of({"wheelbase"}, 200));
  add_doubtful({fit_of({"wear"}, 150), fit_of({"wear", "wheel_radius_scale"}, 220), fit_of({"wear", "wheelbase"}, 202)},
               none, d);
  EXPECT_THAT(d.set, ElementsAre("wheelbase")) << "without the first, or with hardly more evidence";
  add_doubtful({fit_of({"wheelbase", "wear"}, 208), fit_of({"wheelbase", "backlash"}, 206)}, none, d);
  EXPECT_THAT(d.set, ElementsAre("wheelbase", "wear+wheelbase"));
}

// The top of the hill of a place is found to a share of what the place explains.
TEST(AnswerSet, WhatStandsBesideTheSamePlaceIsTiedFromFurther) {
  const auto causes = [](bool local) {
    std::vector<Cause> all;
    for (const auto& [effect, score] : {std::pair{"tyre_compliance", 2e5}, std::pair{"wheel_radius_scale", 2e5 - 20}}) {
      Fit fit = fit_of({effect}, score);
      if (local) fit.hypotheses.push_back(patch_hypothesis(1, 2));
      all.push_back({fit.name(), fit, score, 0});
    }
    return all;
  };
  EXPECT_THAT(tied(causes(false), {}), ElementsAre("tyre_compliance"));
  EXPECT_THAT(tied(causes(true), {}),
              ElementsAre("slippery_patch+tyre_compliance", "slippery_patch+wheel_radius_scale"));
}

TEST(AnswerSet, NothingStandsBesideUnknownForBeingDoubtful) {
  const Fit none = fit_of({}, 100);
  Diagnosis d = named(none);
  d.causes.front().name = "unknown";
  d.set = {"unknown"};
  add_doubtful({fit_of({"wheelbase"}, 150)}, none, d);
  EXPECT_THAT(d.set, ElementsAre("unknown"));
}

}  // namespace
}  // namespace umbsim::gap
