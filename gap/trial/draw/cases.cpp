#include "gap/trial/draw/cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace umbsim {
namespace {

int size_of(const TierSizes& sizes, Tier tier) {
  switch (tier) {
    case Tier::no_effect: return sizes.no_effect;
    case Tier::single: return sizes.single;
    case Tier::pairs: return sizes.pairs;
    case Tier::outside: return sizes.outside;
    case Tier::end_points: return sizes.end_points;
    case Tier::poor_runs: return sizes.poor_runs;
  }
  return 0;
}

std::size_t pick(RandomStream& random, std::size_t count) {
  return std::min(count - 1, std::size_t(random.uniform(0, double(count))));
}

// Effects one after another in a random order, so that a tier of n times the catalogue has each n times.
std::vector<const EffectInfo*> shuffled(const TrialPlan& plan, Tier tier) {
  std::vector<const EffectInfo*> effects = plan.effects;
  RandomStream random(plan.seed, "trial effects", std::uint64_t(tier));
  for (std::size_t i = effects.size(); i > 1; --i) std::swap(effects[i - 1], effects[pick(random, i)]);
  return effects;
}

void choose_effects(const TrialPlan& plan, TrialCase& c, const std::vector<const EffectInfo*>& order, int number,
                    RandomStream& random) {
  if (c.tier == Tier::no_effect) return;
  const std::size_t first = std::size_t(number) % order.size();
  c.effects.push_back(order[first]);
  if (c.tier == Tier::pairs) c.effects.push_back(order[(first + 1 + pick(random, order.size() - 1)) % order.size()]);
  const Range& s = plan.severity;
  for (std::size_t i = 0; i < c.effects.size(); ++i) {
    c.severities.push_back(s.min * std::pow(s.max / s.min, random.uniform()));
  }
}

// An effect that the diagnosis must do without: the case's own outside the catalogue; elsewhere now and then an
// innocent one, so that an exclusion by itself does not give an answer away.
void choose_exclusions(const TrialPlan& plan, TrialCase& c, RandomStream& random) {
  const bool decoy = random.uniform() < plan.decoy_exclusions;
  const EffectInfo* innocent = &catalogue()[pick(random, catalogue().size())];
  if (c.tier == Tier::outside) {
    c.excluded = {c.effects.front()->name};
  } else if (decoy && std::find(c.effects.begin(), c.effects.end(), innocent) == c.effects.end()) {
    c.excluded = {innocent->name};
  }
}

std::string random_name(const TrialPlan& plan, std::uint64_t index) {
  return fmt::format("{:012x}", RandomStream(plan.seed, "trial name", index).bits() & 0xffffffffffff);
}

}  // namespace

const char* name(Tier tier) {
  constexpr const char* kNames[] = {"no_effect", "single", "pairs", "outside", "end_points", "poor_runs"};
  return kNames[int(tier)];
}

std::vector<PlannedRun> runs_of(const TrialPlan& plan, Tier tier) {
  return tier == Tier::poor_runs ? plain_runs(plan.runs) : plan.runs;
}

std::vector<TrialCase> draw_cases(const TrialPlan& plan) {
  std::vector<TrialCase> cases;
  for (const Tier tier : kTiers) {
    const std::vector<const EffectInfo*> order = shuffled(plan, tier);
    for (int number = 0; number < size_of(plan.cases, tier); ++number) {
      // Index by tier and number: a trial with more cases has the cases of the smaller one.
      const std::uint64_t index = (std::uint64_t(tier) << 32) + std::uint64_t(number);
      RandomStream random(plan.seed, "trial case", index);
      TrialCase c{random_name(plan, index), index, tier, 0, 1, 0, {}, {}, {}};
      c.platform = int(pick(random, std::size_t(plan.platforms.count)));
      c.noise_level = random.uniform(plan.noise.level.min, plan.noise.level.max);
      c.seed = random.bits() >> 1;
      choose_effects(plan, c, order, number, random);
      choose_exclusions(plan, c, random);
      cases.push_back(std::move(c));
    }
  }
  std::sort(cases.begin(), cases.end(), [](const TrialCase& a, const TrialCase& b) { return a.name < b.name; });
  return cases;
}

}  // namespace umbsim
