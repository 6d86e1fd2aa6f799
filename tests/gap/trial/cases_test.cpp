#include "gap/trial/draw/cases.h"

#include <algorithm>
#include <set>

#include "tests/gap/trial/fake_simulator.h"

namespace umbsim::trial_testing {
namespace {

TrialPlan large_plan() {
  TrialPlan plan = small_plan();
  plan.effects.clear();
  for (const EffectInfo& info : catalogue()) plan.effects.push_back(&info);
  plan.cases = {40, 2 * int(catalogue().size()), 30, 40, 5, 5};
  plan.platforms.count = 3;
  return plan;
}

std::vector<TrialCase> of_tier(const std::vector<TrialCase>& cases, Tier tier) {
  std::vector<TrialCase> chosen;
  std::copy_if(cases.begin(), cases.end(), std::back_inserter(chosen),
               [&](const TrialCase& c) { return c.tier == tier; });
  return chosen;
}

TEST(Cases, AreAsManyAsPlannedAndEachEffectComesAsOften) {
  const TrialPlan plan = large_plan();
  const std::vector<TrialCase> cases = draw_cases(plan);
  EXPECT_EQ(of_tier(cases, Tier::no_effect).size(), 40u);
  EXPECT_EQ(of_tier(cases, Tier::pairs).size(), 30u);
  std::map<std::string, int> counts;
  for (const TrialCase& c : of_tier(cases, Tier::single)) {
    ASSERT_EQ(c.effects.size(), 1u);
    ++counts[c.effects.front()->name];
  }
  ASSERT_EQ(counts.size(), catalogue().size());
  for (const auto& [effect, count] : counts) EXPECT_EQ(count, 2) << effect;
  for (const TrialCase& c : of_tier(cases, Tier::no_effect)) EXPECT_TRUE(c.effects.empty());
  for (const TrialCase& c : of_tier(cases, Tier::pairs)) {
    ASSERT_EQ(c.effects.size(), 2u);
    EXPECT_NE(c.effects[0], c.effects[1]);
  }
}

TEST(Cases, SeveritiesCoverTheirRangeOnALogScale) {
  const TrialPlan plan = large_plan();
  const double middle = std::sqrt(plan.severity.min * plan.severity.max);
  int below = 0, all = 0;
  for (const TrialCase& c : draw_cases(plan)) {
    for (const double s : c.severities) {
      EXPECT_GE(s, plan.severity.min);
      EXPECT_LE(s, plan.severity.max);
      below += s < middle;
      ++all;
    }
  }
  // Binomial with p = 1/2: four standard deviations.
  EXPECT_NEAR(double(below) / all, 0.5, 4 * 0.5 / std::sqrt(double(all)));
}

TEST(Cases, TheSameSeedGivesTheSameCasesAnotherSeedOthers) {
  TrialPlan plan = large_plan();
  const std::vector<TrialCase> a = draw_cases(plan), b = draw_cases(plan);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].name, b[i].name);
    EXPECT_EQ(a[i].seed, b[i].seed);
    EXPECT_EQ(a[i].effects, b[i].effects);
    EXPECT_EQ(a[i].severities, b[i].severities);
  }
  plan.seed += 1;
  std::set<std::string> names, others;
  for (const TrialCase& c : a) names.insert(c.name);
  for (const TrialCase& c : draw_cases(plan)) {
    EXPECT_EQ(names.count(c.name), 0u);
    others.insert(c.name);
  }
  EXPECT_EQ(names.size(), a.size());
  EXPECT_EQ(others.size(), a.size());
}

TEST(Cases, ALargerTrialHasTheCasesOfTheSmallerOne) {
  TrialPlan small = large_plan(), large = large_plan();
  large.cases.no_effect += 5;
  large.cases.single += 5;
  std::map<std::string, std::uint64_t> seeds;
  for (const TrialCase& c : draw_cases(large)) seeds[c.name] = c.seed;
  for (const TrialCase& c : draw_cases(small)) EXPECT_EQ(seeds.at(c.name), c.seed);
}

TEST(Cases, TheOrderOfNamesTellsNothingOfTheTier) {
  const std::vector<TrialCase> cases = draw_cases(large_plan());
  // Mean rank of the 40 cases without effect among n names in random order: mean (n - 1) / 2, variance n^2 / 12 / 40.
  double rank = 0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    EXPECT_EQ(cases[i].name.size(), 12u);
    if (cases[i].tier == Tier::no_effect) rank += double(i) / 40;
  }
  const double n = double(cases.size());
  EXPECT_NEAR(rank, (n - 1) / 2, 4 * n / std::sqrt(12.0 * 40));
}

TEST(Cases, OutsideTheCatalogueMeansExcludedAndElsewhereOnlyTheInnocentAre) {
  int decoys = 0, others = 0;
  for (const TrialCase& c : draw_cases(large_plan())) {
    std::set<std::string> effects;
    for (const EffectInfo* info : c.effects) effects.insert(info->name);
    if (c.tier == Tier::outside) {
      ASSERT_EQ(c.excluded.size(), 1u);
      EXPECT_EQ(effects.count(c.excluded.front()), 1u);
      continue;
    }
    ++others;
    decoys += int(c.excluded.size());
    for (const std::string& name : c.excluded) EXPECT_EQ(effects.count(name), 0u);
  }
  EXPECT_NEAR(double(decoys) / others, 0.25, 4 * std::sqrt(0.25 * 0.75 / others));
}

TEST(Cases, ThePoorSetHasThePlainRunsOnly) {
  const TrialPlan plan = large_plan();
  EXPECT_EQ(runs_of(plan, Tier::single).size(), 12u);
  const std::vector<PlannedRun> poor = runs_of(plan, Tier::poor_runs);
  ASSERT_EQ(poor.size(), 4u);
  for (const PlannedRun& run : poor) EXPECT_TRUE(run.plain());
}

}  // namespace
}  // namespace umbsim::trial_testing
