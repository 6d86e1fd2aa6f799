#include "gap/answer/answer_set.h"

#include <algorithm>
#include <utility>

#include "gap/evidence/uneven_floor.h"

namespace umbsim::gap {
namespace {

constexpr double kGoodPart = 0.3;       // of what a combination explains, for one of its effects alone
constexpr double kWorthSaying = 3;      // log evidence of what is too small to be named, or does not pay
constexpr std::size_t kMostFaint = 2;   // effects that stand beside "none", whatever evidence they have
constexpr double kWorthKnowing = 0.05;  // what effects explain, over the misfit that they leave
constexpr double kAlikeFaint = 10;      // times the smallest p-value

bool holds_all(const Fit& fit, const Fit& part) {
  return std::all_of(part.hypotheses.begin(), part.hypotheses.end(), [&](const Hypothesis& f) {
    return std::any_of(fit.hypotheses.begin(), fit.hypotheses.end(),
                       [&](const Hypothesis& g) { return g.effect == f.effect; });
  });
}

void add_to_set(const std::string& name, Diagnosis& d) {
  if (std::find(d.set.begin(), d.set.end(), name) == d.set.end()) d.set.push_back(name);
}

// An explanation, and those of its effects that explain much of the same alone.
void add_what_explains(const Fit& best, const Fit& none, Diagnosis& d) {
  add_to_set(best.name(), d);
  const double all = best.log_evidence - none.log_evidence;
  for (const Cause& c : d.causes) {
    const bool part = c.fit.hypotheses.size() == 1 &&
                      std::any_of(best.hypotheses.begin(), best.hypotheses.end(),
                                  [&](const Hypothesis& f) { return f.effect == c.fit.hypotheses.front().effect; });
    if (part && c.fit.log_evidence - none.log_evidence > kGoodPart * all) add_to_set(c.name, d);
  }
}

// What counts and commands plainly show: it is there, whatever else there may be.
void add_what_counts_show(const Model& model, const Fit& none, const Thresholds& t, Diagnosis& d) {
  const double before = model.counts_misfit(none);
  for (const Cause& c : d.causes) {
    if (c.fit.hypotheses.size() != 1 || !shows_in_counts(c.fit.hypotheses.front())) continue;
    if (before - model.counts_misfit(c.fit) < 2 * t.plainly_shown) continue;
    add_to_set(c.name, d);
  }
}

}  // namespace

std::vector<std::string> tied(const std::vector<Cause>& causes, const Thresholds& t) {
  std::vector<std::string> names;
  const Cause& first = causes.front();
  for (const Cause& c : causes) {
    if (c.name == "none" && first.name != "none") continue;
    const double near_top = first.fit.is_local() && c.fit.is_local() ? t.top * first.score : 0;
    if (first.score - c.score <= t.tie + near_top) names.push_back(c.name);
  }
  return names;
}

void add_doubtful(const std::vector<Fit>& doubtful, const Fit& none, Diagnosis& d) {
  const Cause& first = d.causes.front();
  if (first.name == "unknown") return;
  const bool nothing = first.name == "none";
  const std::size_t effects = (nothing ? 0 : first.fit.hypotheses.size()) + 1;
  const double known = nothing ? none.log_evidence : first.fit.log_evidence;
  const Fit* likeliest = nullptr;
  for (const Fit& f : doubtful) {
    if (f.hypotheses.size() != effects || f.log_evidence < known + kWorthSaying) continue;
    if (!nothing && !holds_all(f, first.fit)) continue;
    if (!likeliest || f.log_evidence > likeliest->log_evidence) likeliest = &f;
  }
  if (likeliest) add_to_set(likeliest->name(), d);
}

void add_faint(const std::map<std::string, double>& p_values, const Thresholds& t, Diagnosis& d) {
  if (d.causes.front().name != "none" || d.set.size() > 1) return;
  std::vector<std::pair<double, std::string>> likeliest;
  for (const auto& [effect, p] : p_values) likeliest.push_back({p, effect});
  std::sort(likeliest.begin(), likeliest.end());
  if (likeliest.size() > kMostFaint) likeliest.resize(kMostFaint);
  for (const auto& [p, effect] : likeliest) {
    if (p < t.faint && p <= kAlikeFaint * likeliest.front().first) add_to_set(effect, d);
  }
}

void fill_set(const Context& w, const Found& found, const LeftUnexplained& left, const Fit& best, Diagnosis& d) {
  d.set = tied(d.causes, w.thresholds);
  if (d.causes.front().name == "unknown") {
    // What explains more than anything of no particular cause could is worth knowing, even where it is not the whole.
    if (!best.hypotheses.empty() && w.explained_by(best) > std::max(left.steady(), kWorthKnowing * left.lack))
      add_what_explains(best, w.none, d);
    add_what_counts_show(w.model, w.none, w.thresholds, d);
    if (w.may_name(kUnevenFloor) && may_be_uneven_floor(w.model, w.none)) d.set.push_back(kUnevenFloor);
  }
  add_doubtful(found.doubtful, w.none, d);
  add_faint(found.p_values, w.thresholds, d);
}

}  // namespace umbsim::gap
