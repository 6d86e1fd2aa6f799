#include "gap/search/local_search.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "gap/search/pattern_search.h"

namespace umbsim::gap {
namespace {

constexpr double kFirstStep = 0.4;  // of a number, where a search begins
constexpr int kHalvings = 4;
constexpr double kClosely = 0.25;  // of first steps, near the top
constexpr double kOneHill = 2.1;   // first steps, within which a worse start is on the way to the same top
constexpr double kReachAgain = 2;  // steps of each number, to which a place is looked for again
constexpr int kSearchesAgain = 2;
constexpr int kMostTries = 200;         // simulations of the runs in the search for a place
constexpr std::ptrdiff_t kBegunOn = 3;  // runs
constexpr std::size_t kKeptOfFew = 3;   // starts for each local search, to be tried on all runs

}  // namespace

std::function<double(const Eigen::VectorXd&)> density_on(const Model& model, const Fit& base,
                                                         const Hypothesis& hypothesis,
                                                         const std::vector<std::size_t>& runs) {
  std::vector<Hypothesis> hypotheses = base.hypotheses;
  hypotheses.push_back(hypothesis);
  return [&model, hypotheses, runs, p = base.p](const Eigen::VectorXd& numbers) {
    Eigen::VectorXd all(p.size() + numbers.size());
    all << p, numbers;
    try {
      return model.density_at(hypotheses, all, runs);
    } catch (const RunError&) {
      return -1e300;
    } catch (const InputError&) {
      return -1e300;  // it does not stand at its start, on a cable or without a wheel's floor
    }
  };
}

namespace {

// The top of the hill from one start; `closely`: a start that is near it.
Eigen::VectorXd local_search(const std::function<double(const Eigen::VectorXd&)>& density, const Screen::Candidate& c,
                             const Eigen::VectorXd& start, bool closely) {
  Eigen::VectorXd reach = closely ? kClosely * c.reach : c.reach;
  Eigen::VectorXd min(start.size());
  Eigen::VectorXd max(start.size());
  for (Eigen::Index i = 0; i < start.size(); ++i) {
    if (start[i] != 0) reach[i] = std::min(reach[i], kFirstStep * std::abs(start[i]));
    min[i] = c.hypothesis.parameters[std::size_t(i)].min;
    max[i] = c.hypothesis.parameters[std::size_t(i)].max;
  }
  return pattern_search(density, start, reach, min, max, closely ? kHalvings - 2 : kHalvings, kMostTries);
}

}  // namespace

namespace {

// The best starts of different hills, best first, as some runs see them; the density of the first.
double keep_best(const std::function<double(const Eigen::VectorXd&)>& density, std::size_t most, Screen::Candidate& c) {
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < c.starts.size(); ++i) order.push_back({-density(c.starts[i]), i});
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
    keep_best(density_on(model, base, c.hypothesis, begun_on(c)), kKeptOfFew * local_searches, c);
  return keep_best(density_on(model, base, c.hypothesis), local_searches, c);
}

std::optional<Eigen::VectorXd> searched_start(const Model& model, const Fit& base, Screen::Candidate c, double least) {
  if (c.starts.empty()) c.starts = {c.start};
  if (c.starts.size() > std::size_t(c.local_searches)) keep_best_starts(model, base, c);
  if (c.reach.size() == 0) return c.starts.front();
  const auto density = density_on(model, base, c.hypothesis);
  if (!c.any_start && density(c.starts.front()) < least) return std::nullopt;
  double highest = -1e301;
  Eigen::VectorXd best;
  for (const Eigen::VectorXd& start : c.starts) {
    const Eigen::VectorXd top = local_search(density_on(model, base, c.hypothesis, begun_on(c)), c, start, false);
    const double there = density(top);
    if (there <= highest) continue;
    highest = there;
    best = top;
  }
  // Whether a wheel comes across a place is a matter of millimetres: the few runs do not speak for all.
  return c.shown_by.empty() ? best : local_search(density, c, best, true);
}

Eigen::VectorXd searched_again(const Model& model, const Fit& base, const Hypothesis& more,
                               const Eigen::VectorXd& numbers) {
  Fit others;
  others.hypotheses.push_back(more);
  std::vector<double> held(numbers.data(), numbers.data() + numbers.size());
  Screen::Candidate local;
  Eigen::Index local_at = 0;
  Eigen::Index at = 0;
  for (const Hypothesis& f : base.hypotheses) {
    const Eigen::Index n = Eigen::Index(f.parameters.size());
    if (f.search_cost > 0) {
      local.hypothesis = f;
      local.start = base.p.segment(at, n);
      local_at = at;
    } else {
      others.hypotheses.push_back(f);
      held.insert(held.end(), base.p.data() + at, base.p.data() + at + n);
    }
    at += n;
  }
  others.p = Eigen::Map<const Eigen::VectorXd>(held.data(), Eigen::Index(held.size()));
  local.starts = {local.start};
  local.reach.resize(local.start.size());
  for (Eigen::Index i = 0; i < local.start.size(); ++i) {
    const FreeParameter& p = local.hypothesis.parameters[std::size_t(i)];
    local.reach[i] = kReachAgain * p.step;
    std::vector<Eigen::VectorXd> more_starts;
    for (const Eigen::VectorXd& start : local.starts) {
      for (const double aside : {-1.0, 0.0, 1.0}) {
        more_starts.push_back(start);
        more_starts.back()[i] = std::clamp(start[i] + aside * kReachAgain * p.step, p.min, p.max);
      }
    }
    local.starts = std::move(more_starts);
  }
  local.local_searches = kSearchesAgain;
  local.any_start = true;
  Eigen::VectorXd start(base.p.size() + numbers.size());
  start << base.p, numbers;
  start.segment(local_at, local.start.size()) = *searched_start(model, others, local, 0);
  return start;
}

}  // namespace umbsim::gap
