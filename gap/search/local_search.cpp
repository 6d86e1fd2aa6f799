#include "gap/search/local_search.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "gap/search/subplex.h"

namespace umbsim::gap {
namespace {

constexpr double kFirstStep = 0.4;       // of a number, where a search begins
constexpr double kLeastStep = 1.0 / 16;  // of the first
constexpr double kClosely = 0.25;        // of first steps: as near to the top as a few runs lead, and all go on from
constexpr double kOneHill = 2.1;         // first steps, within which a worse start is on the way to the same top
constexpr int kRoundsAgain = 4;
constexpr double kReachAgain = 2;       // steps of each number, to which a place is looked for again
constexpr int kMostTries = 200;         // simulations of the runs in the search for a place
constexpr std::ptrdiff_t kBegunOn = 3;  // runs
constexpr std::size_t kKeptOfFew = 3;   // starts for each local search, to be tried on all runs

using Density = std::function<double(const Eigen::VectorXd&)>;

// The same, and next to nothing where the robot cannot be driven: it tips over, or does not stand at its start, on a
// cable or without a wheel's floor.
Density where_driven(Density density) {
  return [density = std::move(density)](const Eigen::VectorXd& numbers) {
    try {
      return density(numbers);
    } catch (const RunError&) {
      return -1e300;
    } catch (const InputError&) {
      return -1e300;
    }
  };
}

}  // namespace

std::function<double(const Eigen::VectorXd&)> density_on(const Model& model, const Fit& base,
                                                         const Hypothesis& hypothesis,
                                                         const std::vector<std::size_t>& runs) {
  std::vector<Hypothesis> hypotheses = base.hypotheses;
  hypotheses.push_back(hypothesis);
  return where_driven([&model, hypotheses, runs, p = base.p](const Eigen::VectorXd& numbers) {
    Eigen::VectorXd all(p.size() + numbers.size());
    all << p, numbers;
    return model.density_at(hypotheses, all, runs);
  });
}

std::function<double(const Eigen::VectorXd&)> density_beside(const Model& model, const Fit& base,
                                                             const Hypothesis& hypothesis,
                                                             const std::vector<std::size_t>& some) {
  if (base.hypotheses.empty()) return density_on(model, base, hypothesis, some);
  const std::vector<std::size_t> runs = some.empty() ? model.all_runs() : some;
  std::vector<Eigen::VectorXd> before = model.residuals(base.predicted);
  const std::vector<Eigen::VectorXd> alone = model.residuals(model.none().predicted);
  for (std::size_t r = 0; r < before.size(); ++r) before[r] -= alone[r];
  return where_driven([&model, hypothesis, runs, before, others = base.effects()](const Eigen::VectorXd& numbers) {
    std::vector<Effect> effects = effects_of(hypothesis, numbers);
    std::vector<Eigen::VectorXd> residual = model.residuals(model.predict({effects}, runs).front());
    for (const std::size_t r : runs) residual[r] += before[r];
    effects.insert(effects.end(), others.begin(), others.end());
    return evidence(model.grams(residual, {}), runs, first_columns(model.nuisances()), model.nuisance_sds())
               .log_density +
           model.log_chance(effects);
  });
}

namespace {

// Of numbers before the recording is looked at: where it does not tell a place, the place is where the robot felt it.
double log_prior(const Hypothesis& hypothesis, const Eigen::VectorXd& numbers) {
  return -0.5 * numbers.cwiseQuotient(prior_sd_of({hypothesis})).squaredNorm();
}

// The top of the hill from one start, with steps from one share of the candidate's reach to another.
Eigen::VectorXd local_search(const Density& density, const Screen::Candidate& c, const Eigen::VectorXd& start,
                             double first_step, double least_step) {
  Eigen::VectorXd reach = first_step * c.reach;
  Eigen::VectorXd min(start.size());
  Eigen::VectorXd max(start.size());
  for (Eigen::Index i = 0; i < start.size(); ++i) {
    if (start[i] != 0) reach[i] = std::min(reach[i], kFirstStep * std::abs(start[i]));
    min[i] = c.hypothesis.parameters[std::size_t(i)].min;
    max[i] = c.hypothesis.parameters[std::size_t(i)].max;
  }
  return subplex(density, start, reach, min, max, least_step / first_step, kMostTries);
}

// The best starts of different hills, best first, as some runs see them; the density of the first.
double keep_best(const Density& density, std::size_t most, Screen::Candidate& c) {
  std::vector<std::pair<double, std::size_t>> order(c.starts.size());
  tbb::parallel_for(std::size_t(0), order.size(), [&](std::size_t i) { order[i] = {-density(c.starts[i]), i}; });
  std::sort(order.begin(), order.end());
  std::vector<Eigen::VectorXd> best;
  for (const auto& [negative, i] : order) {
    const Eigen::VectorXd& start = c.starts[i];
    const bool other_hill = std::none_of(best.begin(), best.end(), [&](const Eigen::VectorXd& b) {
      return c.reach.size() > 0 && ((start - b).cwiseAbs().array() < kOneHill * c.reach.array()).all();
    });
    if (other_hill) best.push_back(start);
    if (best.size() == most) break;
  }
  c.starts = std::move(best);
  return -order.front().first;
}

// The runs on which a search is begun: a few that show most. Empty: all.
std::vector<std::size_t> begun_on(const Screen::Candidate& c) {
  return {c.shown_by.begin(), c.shown_by.begin() + std::min(kBegunOn, std::ptrdiff_t(c.shown_by.size()))};
}

}  // namespace

double keep_best_starts(const Model& model, const Fit& base, Screen::Candidate& c) {
  const std::size_t local_searches = std::size_t(c.local_searches);
  if (!c.shown_by.empty())
    keep_best(density_beside(model, base, c.hypothesis, begun_on(c)), kKeptOfFew * local_searches, c);
  return keep_best(density_beside(model, base, c.hypothesis), local_searches, c);
}

std::optional<Eigen::VectorXd> searched_start(const Model& model, const Fit& base, Screen::Candidate c, double least) {
  if (c.starts.empty()) c.starts = {c.start};
  if (c.starts.size() > std::size_t(c.local_searches)) keep_best_starts(model, base, c);
  if (c.reach.size() == 0) return c.starts.front();
  const auto density = [&, likelihood = density_on(model, base, c.hypothesis)](const Eigen::VectorXd& numbers) {
    return likelihood(numbers) + log_prior(c.hypothesis, numbers);
  };
  if (!c.any_start && density(c.starts.front()) < least) return std::nullopt;
  std::vector<Eigen::VectorXd> tops(c.starts.size());
  std::vector<double> heights(c.starts.size());
  const Density on_few = density_on(model, base, c.hypothesis, begun_on(c));
  tbb::parallel_for(std::size_t(0), tops.size(), [&](std::size_t i) {
    tops[i] = local_search(on_few, c, c.starts[i], 1, c.shown_by.empty() ? kLeastStep : kClosely);
    heights[i] = density(tops[i]);
  });
  const auto highest = std::max_element(heights.begin(), heights.end());
  if (*highest < least) return std::nullopt;
  const Eigen::VectorXd& best = tops[std::size_t(highest - heights.begin())];
  // Whether a wheel comes across a place is a matter of millimetres: the few runs do not speak for all.
  return c.shown_by.empty() ? best : local_search(density, c, best, kClosely, kLeastStep);
}

namespace {

// One hypothesis of a fit, and where its numbers are among all.
struct Placed {
  const Hypothesis* hypothesis;
  Eigen::Index at;
  Eigen::Index count;
};

std::optional<Placed> place_of(const Fit& fit) {
  Eigen::Index at = 0;
  for (const Hypothesis& h : fit.hypotheses) {
    const Eigen::Index count = Eigen::Index(h.parameters.size());
    if (h.search_cost > 0) return Placed{&h, at, count};
    at += count;
  }
  return std::nullopt;
}

Eigen::VectorXd without_place(const Eigen::VectorXd& numbers, const Placed& place) {
  const Eigen::Index after = place.at + place.count;
  Eigen::VectorXd others(numbers.size() - place.count);
  others << numbers.head(place.at), numbers.tail(numbers.size() - after);
  return others;
}

// Log density of numbers of the place, those of the other effects integrated out by their derivatives in the fit.
Density density_beside_others(const Model& model, const Fit& fit, const Placed& place) {
  const Eigen::VectorXd other_sd = without_place(prior_sd_of(fit.hypotheses), place);
  std::vector<Eigen::MatrixXd> columns;
  for (const Eigen::MatrixXd& c : fit.columns) {
    columns.emplace_back(c.rows(), other_sd.size());
    columns.back() << c.leftCols(place.at), c.rightCols(c.cols() - place.at - place.count);
  }
  Eigen::VectorXd shift = Eigen::VectorXd::Zero(model.nuisances() + other_sd.size());
  shift.tail(other_sd.size()) = without_place(fit.p, place);
  const std::vector<int> chosen = first_columns(shift.size());
  const std::vector<Eigen::VectorXd> sds = with_more(model.nuisance_sds(), other_sd);
  return [=, &model, &fit](const Eigen::VectorXd& numbers) {
    Fit moved;
    moved.hypotheses = fit.hypotheses;
    moved.p = fit.p;
    moved.p.segment(place.at, place.count) = numbers;
    try {
      const auto residual = model.residuals(model.predict({moved.effects()}).front());
      return evidence(model.grams(residual, columns), model.all_runs(), chosen, sds, shift).log_density +
             log_prior(*place.hypothesis, numbers);
    } catch (const RunError&) {
      return -1e300;
    } catch (const InputError&) {
      return -1e300;
    }
  };
}

}  // namespace

Fit with_place_searched_again(const Model& model, const Fit& fit) {
  const std::optional<Placed> place = place_of(fit);
  if (!place || fit.hypotheses.size() < 2) return fit;
  Eigen::VectorXd reach(place->count);
  Eigen::VectorXd min(place->count);
  Eigen::VectorXd max(place->count);
  for (Eigen::Index i = 0; i < place->count; ++i) {
    const FreeParameter& p = place->hypothesis->parameters[std::size_t(i)];
    reach[i] = kReachAgain * p.step;
    min[i] = p.min;
    max[i] = p.max;
  }
  const Eigen::VectorXd start = fit.p.segment(place->at, place->count);
  Eigen::VectorXd numbers = fit.p;
  numbers.segment(place->at, place->count) =
      subplex(density_beside_others(model, fit, *place), start, reach, min, max, kLeastStep, kMostTries);
  const Fit again = model.fit(fit.hypotheses, numbers, {kRoundsAgain});
  return again.log_evidence > fit.log_evidence ? again : fit;
}

std::vector<Fit> with_the_best_place(const Model& model, std::vector<Fit> fits) {
  const auto less = [](const Fit& a, const Fit& b) { return a.log_evidence < b.log_evidence; };
  const auto best = std::max_element(fits.begin(), fits.end(), less);
  if (best == fits.end()) return fits;
  const std::optional<Placed> place = place_of(*best);
  for (Fit& fit : fits) {
    const std::optional<Placed> own = place_of(fit);
    if (!place || !own || own->hypothesis->effect != place->hypothesis->effect || own->at != place->at) continue;
    Eigen::VectorXd numbers = fit.p;
    numbers.segment(own->at, own->count) = best->p.segment(place->at, place->count);
    if (numbers == fit.p) continue;
    Fit again = with_place_searched_again(model, model.fit(fit.hypotheses, numbers, {kRoundsAgain}));
    if (again.log_evidence <= fit.log_evidence) continue;
    again.size = fit.size;
    again.seen = fit.seen;
    fit = std::move(again);
  }
  return fits;
}

}  // namespace umbsim::gap
