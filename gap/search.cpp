#include "gap/search.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "gap/noise_floor.h"
#include "gap/pattern_search.h"

namespace umbsim::gap {
namespace {

constexpr std::size_t kSinglesFitted = 8;
constexpr std::size_t kAdditionsFitted = 4;
constexpr double kFarBehind = 20;  // log evidence
constexpr int kHalvings = 3;
constexpr int kMostTries = 110;  // simulations of all runs in the search for a place

// Numbers of the candidate's family with which a fit on top of `base` begins.
Eigen::VectorXd searched_start(const Model& model, const Fit& base, const Screen::Candidate& c) {
  std::vector<Family> families = base.families;
  families.push_back(c.family);
  const Eigen::Index own = base.p.size();
  const auto density = [&](const Eigen::VectorXd& p) {
    Eigen::VectorXd all(own + p.size());
    all << base.p, p;
    try {
      return model.density_at(families, all);
    } catch (const RunError&) {
      return -1e300;
    } catch (const InputError&) {
      return -1e300;  // it does not stand at its start, on a cable or without a wheel's floor
    }
  };
  Eigen::VectorXd best = c.start;
  double best_density = -1e300;
  for (const Eigen::VectorXd& start : c.starts) {
    const double there = density(start);
    if (there <= best_density) continue;
    best_density = there;
    best = start;
  }
  if (c.reach.size() == 0) return best;
  Eigen::VectorXd min(best.size());
  Eigen::VectorXd max(best.size());
  for (Eigen::Index i = 0; i < best.size(); ++i) {
    min[i] = c.family.parameters[std::size_t(i)].min;
    max[i] = c.family.parameters[std::size_t(i)].max;
  }
  return pattern_search(density, best, c.reach, min, max, kHalvings, kMostTries);
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
  const double best_gain = singles.empty() ? 0 : singles.front().gain;
  for (std::size_t i = 0; i < singles.size(); ++i) {
    // Where the simulator bends, the screen is only a hint: such families are tried a little longer.
    const double needed = singles[i].family.from_zero ? 2 : 1;
    if (singles[i].gain < needed) continue;
    if (i >= kSinglesFitted && singles[i].gain < best_gain - 15) continue;
    // Places and moments take many simulations: not where something else explains all that noise does not.
    const bool explained = std::any_of(fits.begin() + 1, fits.end(), [&](const Fit& f) {
      return explains_all(model, f, thresholds) && f.log_evidence - fits.front().log_evidence > singles[i].gain;
    });
    if (singles[i].reach.size() > 0 && explained) continue;
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
