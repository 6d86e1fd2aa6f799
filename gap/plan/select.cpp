#include "gap/plan/select.h"

#include <algorithm>

namespace umbsim::gap {
namespace {

// A further run has to separate this much, in pairs: less is the sampling error of the prediction.
constexpr double kLeastGain = 0.25;

std::vector<std::size_t> with(std::vector<std::size_t> runs, std::size_t one) {
  runs.push_back(one);
  std::sort(runs.begin(), runs.end());
  return runs;
}

bool shown(const Separation& s, const std::string& effect) {
  return std::find(s.not_shown.begin(), s.not_shown.end(), effect) == s.not_shown.end();
}

bool told_apart(const Separation& s, const std::string& a, const std::string& b) {
  if (!shown(s, a) || !shown(s, b)) return false;
  return std::none_of(s.alike.begin(), s.alike.end(), [&](const auto& p) { return p.first == Pair{a, b}; });
}

PlanStep step(std::size_t run, const Separation* before, const Separation& after) {
  PlanStep s{run, {}, {}};
  const std::vector<std::string>& effects = after.race.effects;
  for (std::size_t i = 0; i < effects.size(); ++i) {
    if (shown(after, effects[i]) && !(before && shown(*before, effects[i]))) s.shows.push_back(effects[i]);
    for (std::size_t j = i + 1; j < effects.size(); ++j) {
      if (!told_apart(after, effects[i], effects[j])) continue;
      if (!(before && told_apart(*before, effects[i], effects[j]))) s.separates.push_back({effects[i], effects[j]});
    }
  }
  return s;
}

std::vector<std::size_t> grown(const std::vector<std::size_t>& base, std::vector<std::size_t> candidates,
                               const Judge& judge, int wanted) {
  std::vector<std::size_t> chosen;
  std::vector<std::size_t> all = base;
  Separation now;
  if (!base.empty()) now = judge(base);
  while (!candidates.empty() && now.separated < wanted) {
    std::size_t best = 0;
    Separation most;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      Separation s = judge(with(all, candidates[i]));
      if (i == 0 || s.soft > most.soft) {
        best = i;
        most = std::move(s);
      }
    }
    if (most.separated <= now.separated && most.soft < now.soft + kLeastGain) break;
    chosen.push_back(candidates[best]);
    all = with(all, candidates[best]);
    candidates.erase(candidates.begin() + std::ptrdiff_t(best));
    now = std::move(most);
  }
  return chosen;
}

std::vector<std::size_t> joined(std::vector<std::size_t> a, const std::vector<std::size_t>& b) {
  a.insert(a.end(), b.begin(), b.end());
  std::sort(a.begin(), a.end());
  return a;
}

}  // namespace

Recommendation select_runs(const std::vector<std::size_t>& base, const std::vector<std::size_t>& candidates,
                           const Judge& judge) {
  const int wanted = judge(joined(base, candidates)).separated;
  std::vector<std::size_t> chosen = grown(base, candidates, judge, wanted);
  const int reached = chosen.empty() ? 0 : judge(joined(base, chosen)).separated;
  // The first ones were chosen when nothing else was there.
  for (std::size_t i = 0; i < chosen.size() && chosen.size() > 1;) {
    std::vector<std::size_t> fewer = chosen;
    fewer.erase(fewer.begin() + std::ptrdiff_t(i));
    if (judge(joined(base, fewer)).separated >= reached)
      chosen = std::move(fewer);
    else
      ++i;
  }
  Recommendation r;
  std::vector<std::size_t> all = base;
  if (!base.empty()) r.result = judge(base);
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    all = with(all, chosen[i]);
    Separation after = judge(all);
    r.steps.push_back(step(chosen[i], i == 0 && base.empty() ? nullptr : &r.result, after));
    r.result = std::move(after);
  }
  return r;
}

}  // namespace umbsim::gap
