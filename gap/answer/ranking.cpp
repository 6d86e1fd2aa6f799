#include "gap/answer/ranking.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "gap/answer/closure.h"
#include "gap/evidence/track_misfit.h"
#include "gap/search/addition.h"

namespace umbsim::gap {
namespace {

constexpr double kAsGood = 1.001;      // held-out error of a combination, over that of something simpler
constexpr double kNoMore = 2;          // mean squares that count as no more than noise, over those that noise makes
constexpr double kLittle = 0.05;       // of what a combination explains: more than that no held-out runs outvote
constexpr double kOverconfidence = 2;  // evidence is divided by this before it becomes probability
constexpr double kEqual = 1;           // log evidence
// Share of answers that have little to do with their odds (lapse rate, Wichmann & Hill 2001): of recordings that this
// simulator made, and of others. docs/worlds.md, "How sure an answer may be".
constexpr double kLapsesHere = 0.02;
constexpr double kLapsesElsewhere = 0.3;

// Whether both hold as many effects, and all but one are the same.
bool differ_by_one_effect(const Fit& a, const Fit& b) {
  const auto in_a = [&](const Hypothesis& h) {
    return std::any_of(a.hypotheses.begin(), a.hypotheses.end(),
                       [&](const Hypothesis& g) { return g.effect == h.effect; });
  };
  return a.hypotheses.size() > 1 && a.hypotheses.size() == b.hypotheses.size() &&
         std::count_if(b.hypotheses.begin(), b.hypotheses.end(), in_a) + 1 == std::ptrdiff_t(b.hypotheses.size());
}

// Which numbers a fit leaves free.
std::vector<std::string> free_numbers(const Fit& fit) {
  std::vector<std::string> names;
  for (const Hypothesis& f : fit.hypotheses) names.push_back(f.effect + f.variant);
  return names;
}

}  // namespace

std::vector<Cause> ranked(const std::vector<Fit>& fits, const Thresholds& t) {
  std::map<std::string, Cause> best;
  const double none = fits.front().log_evidence;
  for (const Fit& fit : fits) {
    const double score = fit.log_evidence - none - t.effect_cost * double(fit.hypotheses.size());
    const auto [found, fresh] = best.try_emplace(fit.name(), Cause{fit.name(), fit, score, 0});
    if (!fresh && score > found->second.score) found->second = Cause{fit.name(), fit, score, 0};
  }
  for (const Fit& fit : fits) {
    Cause& cause = best.at(fit.name());
    const bool near = fit.log_evidence > cause.fit.log_evidence - t.variant;
    if (near && free_numbers(fit) != free_numbers(cause.fit)) cause.variants.push_back(fit);
  }
  std::vector<Cause> causes;
  for (auto& [name, cause] : best) causes.push_back(std::move(cause));
  std::stable_sort(causes.begin(), causes.end(), [](const Cause& a, const Cause& b) { return a.score > b.score; });
  return causes;
}

void give_probabilities(std::vector<Cause>& causes, bool elsewhere) {
  double best = -1e300;
  for (const Cause& c : causes) best = std::max(best, c.score);
  double sum = 0;
  for (Cause& c : causes) sum += c.probability = std::exp((c.score - best) / kOverconfidence);
  const double lapses = causes.size() < 2 ? 0 : elsewhere ? kLapsesElsewhere : kLapsesHere;
  for (Cause& c : causes) c.probability = (1 - lapses) * c.probability / sum + lapses / double(causes.size());
}

namespace {

// Whether the effects alone bring the robot no nearer to where it was than none do: what engines differ by would have
// to make up for it. As much as noise makes, either way, is no matter where counts show the effects, or tracks more
// than engines do.
bool leads_away(const Model& model, const Fit& none, const Fit& fit, bool beyond_engines) {
  const bool shown = beyond_engines || std::all_of(fit.hypotheses.begin(), fit.hypotheses.end(),
                                                   [](const Hypothesis& h) { return shows_in_counts(h); });
  const double further_mm = in_sample_error_mm(model, fit) - in_sample_error_mm(model, none);
  return shown ? further_mm > 1000 * model.noise_floor_m() : further_mm >= 0;
}

}  // namespace

std::vector<Fit> worth_their_cost(const Model& model, std::vector<Fit> fits, const LeftUnexplained& left_by_none,
                                  const Thresholds& t) {
  const Fit none = fits.front();
  const bool beyond_engines = left_by_none.beyond_engines(t);
  std::stable_sort(fits.begin(), fits.end(), [](const Fit& a, const Fit& b) {
    return std::pair(a.hypotheses.size(), -a.log_evidence) < std::pair(b.hypotheses.size(), -b.log_evidence);
  });
  std::vector<Fit> kept;
  std::vector<Needed> needed;  // beside each of these
  for (Fit& fit : fits) {
    if (leads_away(model, none, fit, beyond_engines)) continue;
    // Dimensions pay less. What is as good with one of them exchanged is not told apart.
    const auto exchanged = [&](const Fit& other) {
      return model.tracker_is_free() && other.log_evidence < fit.log_evidence + t.tie &&
             differ_by_one_effect(other, fit);
    };
    const bool worthwhile =
        std::any_of(kept.begin(), kept.end(), exchanged) ||
        std::all_of(kept.begin(), kept.end(), [&](const Fit& simpler) {
          if (simpler.hypotheses.empty()) return true;
          const double extra = double(fit.hypotheses.size()) - double(simpler.hypotheses.size());
          return extra <= 0 || pays(model, simpler, fit, needed[std::size_t(&simpler - kept.data())], extra);
        });
    if (!worthwhile) continue;
    needed.push_back(addition_needed(model, fit, none, t));
    kept.push_back(std::move(fit));
  }
  return kept;
}

namespace {

// Whether `other`, of fewer effects, predicts held-out runs better than `closure` says.
bool fewer_predict_better(const Model& model, const Closure& closure, const Fit& other) {
  return closure.after_mm > kAsGood * held_out_closure(model, other).after_mm;
}

// Whether `other`, of as many effects, leaves less than noise makes beyond noise, and `front` leaves more by a noise
// floor.
bool leaves_nothing(const Model& model, const Fit& front, const Closure& closure, const Fit& other) {
  const auto nothing = [&](double other_mm, double front_mm) {
    return std::pow(other_mm, 2) <= kNoMore * std::pow(closure.floor_mm, 2) &&
           front_mm > std::hypot(other_mm, closure.floor_mm);
  };
  return nothing(in_sample_error_mm(model, other), in_sample_error_mm(model, front)) &&
         nothing(held_out_closure(model, other).after_mm, closure.after_mm);
}

}  // namespace

void prefer_what_predicts(const Model& model, std::vector<Cause>& causes, const Thresholds& t) {
  for (;;) {
    const Fit& front = causes.front().fit;
    const auto dimension = [](const Hypothesis& f) { return is_dimension(f.effect); };
    if (model.tracker_is_free() && std::all_of(front.hypotheses.begin(), front.hypotheses.end(), dimension)) return;
    const double counts = model.counts_misfit(front);
    std::vector<const Fit*> others;
    bool any_fewer = false;
    for (std::size_t i = 1; i < causes.size() && causes[i].score > (1 - kLittle) * causes.front().score; ++i) {
      const Fit& other = causes[i].fit;
      const bool fewer = other.hypotheses.size() < front.hypotheses.size();
      if (other.hypotheses.empty() || other.hypotheses.size() > front.hypotheses.size()) continue;
      if (model.counts_misfit(other) >= counts + 2 * t.addition || (fewer && any_fewer)) continue;
      any_fewer = any_fewer || fewer;
      others.push_back(&other);
    }
    if (others.empty()) return;
    const Closure closure = held_out_closure(model, front);
    const bool gives_way = closure.known && std::any_of(others.begin(), others.end(), [&](const Fit* other) {
                             return other->hypotheses.size() < front.hypotheses.size()
                                        ? fewer_predict_better(model, closure, *other)
                                        : leaves_nothing(model, front, closure, *other);
                           });
    if (!gives_way) return;
    causes.erase(causes.begin());
  }
}

void prefer_kinematic(std::vector<Cause>& causes) {
  const Cause& front = causes.front();
  if (front.fit.is_kinematic()) return;
  const auto equal = std::find_if(causes.begin(), causes.end(), [&](const Cause& c) {
    return c.fit.is_kinematic() && c.fit.hypotheses.size() == front.fit.hypotheses.size() &&
           c.score > front.score - kEqual;
  });
  if (equal == causes.end()) return;
  equal->score = front.score;
  std::rotate(causes.begin(), equal, equal + 1);
}

}  // namespace umbsim::gap
