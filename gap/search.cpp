#include "gap/search.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/error.h"
#include "gap/noise_floor.h"
#include "gap/pattern_search.h"

namespace umbsim::gap {
namespace {

constexpr std::size_t kSinglesFitted = 8;
constexpr double kContradicted = 25;  // five standard deviations, squared
constexpr std::size_t kAdditionsFitted = 4;
constexpr double kFarBehind = 20;  // log evidence
constexpr double kHint = 0.02;     // of what explains all, below which no place or moment is looked at
constexpr int kHalvings = 4;
constexpr int kMostTries = 110;  // simulations of all runs in the search for a place

// How well a candidate's numbers do on top of `base`.
std::function<double(const Eigen::VectorXd&)> density_on(const Model& model, const Fit& base, const Family& family) {
  std::vector<Family> families = base.families;
  families.push_back(family);
  return [&model, families, p = base.p](const Eigen::VectorXd& numbers) {
    Eigen::VectorXd all(p.size() + numbers.size());
    all << p, numbers;
    try {
      return model.density_at(families, all);
    } catch (const RunError&) {
      return -1e300;
    } catch (const InputError&) {
      return -1e300;  // it does not stand at its start, on a cable or without a wheel's floor
    }
  };
}

// The candidate with the best of its starts alone. Returns that one's log density.
double keep_best_start(const Model& model, const Fit& base, Screen::Candidate& c) {
  const auto density = density_on(model, base, c.family);
  double best = -1e300;
  for (const Eigen::VectorXd& start : c.starts) {
    const double there = density(start);
    if (there <= best) continue;
    best = there;
    c.start = start;
  }
  c.starts.clear();
  return best;
}

// Numbers of the candidate's family with which a fit on top of `base` begins.
Eigen::VectorXd searched_start(const Model& model, const Fit& base, Screen::Candidate c) {
  keep_best_start(model, base, c);
  if (c.reach.size() == 0) return c.start;
  Eigen::VectorXd min(c.start.size());
  Eigen::VectorXd max(c.start.size());
  for (Eigen::Index i = 0; i < c.start.size(); ++i) {
    min[i] = c.family.parameters[std::size_t(i)].min;
    max[i] = c.family.parameters[std::size_t(i)].max;
  }
  return pattern_search(density_on(model, base, c.family), c.start, c.reach, min, max, kHalvings, kMostTries);
}

// Root mean square of what a fit changes in the whitened tracks.
double seen_between(const Model& model, const Fit& base, const Fit& fit) {
  double square = 0;
  const auto change = model.columns(base.predicted, {fit.predicted}, {1});
  for (std::size_t r = 0; r < change.size(); ++r) {
    square += change[r].topRows(3 * Eigen::Index(model.filter(r).samples())).squaredNorm();
  }
  return std::sqrt(square / model.rows());
}

// Nothing is left but noise, as well as it is known.
bool explains_all(const Model& model, const Fit& fit, const Thresholds& t) {
  return fit.misfit < (1 + t.noise_error) * model.rows();
}

}  // namespace

double addition_needed(const Model& model, const Fit& base, double none, const Thresholds& t) {
  const double excess = std::max(0.0, base.misfit - (1 + t.noise_error) * model.rows());
  return std::max(t.addition + t.addition_share * std::max(0.0, base.log_evidence - none), t.misfit_share * excess / 2);
}

std::vector<Fit> search(const Model& model, const Screen& screen, const Thresholds& thresholds, const Say& say) {
  std::vector<Fit> fits{model.none()};
  say("fitting single effects");
  const auto tried = [&](const Fit base, const Screen::Candidate& c) {
    std::vector<Family> families = base.families;
    families.push_back(c.family);
    try {
      Eigen::VectorXd start(base.p.size() + c.start.size());
      start << base.p, searched_start(model, base, c);
      Fit fit = model.fit(families, start);
      fit.size = displacement_m(fit.predicted.tracks, base.predicted.tracks) / model.noise_floor_m();
      fit.seen = seen_between(model, base, fit);
      // What the counts speak against may not explain the tracks.
      if (model.counts_misfit(fit.predicted) > model.counts_misfit(base.predicted) + kContradicted) return;
      // What moves counts against commands, and not the robot, is seen there.
      const double smallest = base.families.empty() ? thresholds.smallest : thresholds.smallest_addition;
      const bool small = fit.size < smallest && fit.seen < thresholds.least_seen;
      if (small && !shows_in_counts(find_effect(c.family.effect))) return;
      fits.push_back(std::move(fit));
    } catch (const RunError&) {
      // A robot that cannot be simulated is no explanation,
    } catch (const InputError&) {
      // nor is one that does not stand at its start, on a cable or without a wheel's floor.
    }
  };
  std::vector<Screen::Candidate> singles = screen.on_top_of(fits.front());
  // Places and moments take many simulations: not where something else explains all that noise does not, and more than
  // they do where they begin.
  const auto idle = [&](Screen::Candidate& c) {
    double rival = -1e300;
    for (const Fit& f : fits) {
      if (explains_all(model, f, thresholds)) rival = std::max(rival, f.log_evidence - fits.front().log_evidence);
    }
    if (rival < c.gain) return false;
    if (c.gain < kHint * rival) return true;
    return keep_best_start(model, fits.front(), c) - fits.front().log_evidence < rival;
  };
  const double best_gain = singles.empty() ? 0 : singles.front().gain;
  for (std::size_t i = 0; i < singles.size(); ++i) {
    // Where the simulator bends, the screen is only a hint: such families are tried a little longer.
    const double needed = singles[i].family.from_zero ? 2 : 1;
    if (singles[i].gain < needed) continue;
    if (i >= kSinglesFitted && singles[i].gain < best_gain - 15) continue;
    if (!singles[i].starts.empty() && idle(singles[i])) continue;
    tried(fits.front(), singles[i]);
  }
  const double none = fits.front().log_evidence;
  std::vector<Fit> frontier = fits;
  for (int depth = 2; depth <= thresholds.most_effects; ++depth) {
    std::vector<const Fit*> from;
    for (const Fit& f : frontier) {
      if (int(f.families.size()) == depth - 1) from.push_back(&f);
    }
    std::sort(from.begin(), from.end(), [](const Fit* a, const Fit* b) { return a->log_evidence > b->log_evidence; });
    // Go on from the best, and from a second that is nearly as good or explains something quite different.
    if (from.size() > 2) from.resize(2);
    const bool second_is_idle = from.size() == 2 && explains_all(model, *from[0], thresholds) &&
                                from[1]->log_evidence < from[0]->log_evidence - kFarBehind;
    if (second_is_idle) from.resize(1);
    if (from.empty() || from.front()->log_evidence < none + thresholds.detect) break;
    say(depth == 2 ? "fitting pairs of effects" : "fitting combinations of three");
    std::vector<Fit> next;
    for (const Fit* base : from) {
      const double needed = addition_needed(model, *base, none, thresholds);
      std::size_t fitted = 0;
      for (const Screen::Candidate& c : screen.on_top_of(*base)) {
        // The screen is linear: what falls a little short there may still pay in the simulator.
        if (c.gain < 0.5 * needed || fitted == kAdditionsFitted) break;
        const std::size_t before = fits.size();
        tried(*base, c);
        if (fits.size() == before) continue;
        ++fitted;
        if (fits.back().log_evidence > base->log_evidence + needed) {
          next.push_back(fits.back());
        } else {
          fits.pop_back();
        }
      }
    }
    if (next.empty()) break;
    frontier = std::move(next);
  }
  return fits;
}

}  // namespace umbsim::gap
