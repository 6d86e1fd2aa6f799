#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "gap/diagnose.h"
#include "gap/replay/remembered.h"
#include "tests/gap/recordings.h"

namespace umbsim::testing {

/// A recording with what is needed to diagnose it, kept together: they refer to each other.
struct Subject {
  explicit Subject(Recording r, const std::vector<Effect>& believed = {})
      : recording(std::move(r)),
        replay(with_effects(scenario_of(recording, "."), believed), recording),
        campaign(gap::campaign_of(recording)),
        model(campaign, gap::remembered(simulator(replay), recording), gap::Scatter{}) {}
  gap::Diagnosis diagnosed(const std::set<std::string>& excluded = {}) const {
    return gap::diagnose(model, excluded, gap::Thresholds{}, [](const std::string&, double) {});
  }

  static Scenario with_effects(Scenario s, const std::vector<Effect>& effects) {
    s.effects = effects;
    return s;
  }

  Recording recording;
  Replay replay;
  gap::Campaign campaign;
  gap::Model model;
};

/// The fit of the first hypothesis of each of these effects, as for 2000 ticks at 50 Hz.
inline gap::Fit fit_of(const gap::Model& model, const std::vector<std::string>& effects) {
  std::vector<gap::Hypothesis> chosen;
  const std::vector<gap::Hypothesis> all = gap::plain_hypotheses(0.02, 2000);
  for (const std::string& e : effects) {
    const auto found = std::find_if(all.begin(), all.end(), [&](const gap::Hypothesis& h) { return h.effect == e; });
    if (found != all.end()) chosen.push_back(*found);
  }
  EXPECT_EQ(chosen.size(), effects.size());
  return model.fit(chosen);
}

/// A hypothesis by its effect and variant, as for 2000 ticks at 50 Hz. Throws logic_error if there is none.
inline gap::Hypothesis hypothesis_of(const std::string& effect, const std::string& variant) {
  for (const gap::Hypothesis& h : gap::plain_hypotheses(0.02, 2000)) {
    if (h.effect == effect && h.variant == variant) return h;
  }
  throw std::logic_error("no hypothesis " + effect + ", " + variant);
}

}  // namespace umbsim::testing
