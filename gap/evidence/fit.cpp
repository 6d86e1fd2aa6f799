// Fits, and fitting the numbers of effects in the simulator.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <stdexcept>

#include "gap/evidence/model.h"

namespace umbsim::gap {

namespace {

// Effects of the hypotheses that are chosen by their index.
std::vector<Effect> effects_where(const std::vector<Hypothesis>& hypotheses, const Eigen::VectorXd& numbers,
                                  const std::function<bool(std::size_t)>& chosen) {
  std::vector<Effect> all;
  Eigen::Index at = 0;
  for (std::size_t i = 0; i < hypotheses.size(); ++i) {
    const Eigen::Index n = Eigen::Index(hypotheses[i].parameters.size());
    if (chosen(i)) {
      for (Effect& e : effects_of(hypotheses[i], numbers.segment(at, n))) all.push_back(std::move(e));
    }
    at += n;
  }
  return all;
}

}  // namespace

std::vector<Effect> Fit::effects() const {
  return effects_where(hypotheses, p, [](std::size_t) { return true; });
}

std::vector<Effect> Fit::driven_at(const Eigen::VectorXd& numbers, std::size_t without) const {
  return effects_where(hypotheses, numbers,
                       [&](std::size_t i) { return i != without && !hypotheses[i].shape_unknown; });
}

std::string Fit::name() const {
  std::set<std::string> names;
  for (const Hypothesis& f : hypotheses) names.insert(f.effect);
  if (names.empty()) return "none";
  return fmt::format("{}", fmt::join(names, "+"));
}

bool Fit::is_kinematic() const {
  return std::all_of(hypotheses.begin(), hypotheses.end(),
                     [](const Hypothesis& f) { return gap::is_kinematic(f.effect); });
}

bool Fit::is_local() const {
  return std::any_of(hypotheses.begin(), hypotheses.end(), [](const Hypothesis& f) { return f.search_cost > 0; });
}

// Derivatives at the fit's numbers, by a step in every direction: the other way where the robot cannot be driven so.
Linearisation Model::linearised(const Fit& fit) const {
  const std::vector<FreeParameter> free = free_parameters(fit.hypotheses);
  std::vector<double> steps;
  const auto stepped = [&](Eigen::Index i) {
    Eigen::VectorXd p = fit.p;
    p[i] += steps[std::size_t(i)];
    return fit.driven_at(p);
  };
  std::vector<std::vector<Effect>> sets;
  for (Eigen::Index i = 0; i < fit.p.size(); ++i) {
    const FreeParameter& parameter = free[std::size_t(i)];
    steps.push_back(fit.p[i] + parameter.step > parameter.max ? -parameter.step : parameter.step);
    sets.push_back(stepped(i));
  }
  std::vector<Predicted> predicted;
  try {
    predicted = predict(sets);
  } catch (const std::runtime_error&) {
    for (std::size_t i = 0; i < sets.size(); ++i) {
      try {
        predicted.push_back(predict({sets[i]}).front());
      } catch (const std::runtime_error&) {
        steps[i] *= -1;
        predicted.push_back(predict({stepped(Eigen::Index(i))}).front());
      }
    }
  }
  return {fit.p, residuals(fit.predicted), columns(fit.predicted, predicted, steps)};
}

namespace {

// One descent: numbers, the best of them so far, and what is known of the derivatives.
struct Descent {
  std::optional<Linearisation> known;
  bool learned = false;  // from steps, since they were last taken at a point
  double density = -1e300;
  double wanted = 0;  // the next step in standard deviations, without bounds
  double change = 0;  // and within them
};

// Where the linear model has its optimum, within the bounds.
Eigen::VectorXd next_numbers(const Fit& fit, const Eigen::VectorXd& optimum, const std::vector<FreeParameter>& free,
                             Descent& d) {
  Eigen::VectorXd next = optimum;
  d.change = d.wanted = 0;
  for (Eigen::Index i = 0; i < next.size(); ++i) {
    const double sd_left = std::sqrt(fit.covariance(i, i) + 1e-300);
    d.wanted = std::max(d.wanted, std::abs(next[i] - fit.p[i]) / sd_left);
    next[i] = std::clamp(next[i], free[std::size_t(i)].min, free[std::size_t(i)].max);
    d.change = std::max(d.change, std::abs(next[i] - fit.p[i]) / sd_left);
  }
  return next;
}

// What does not act in proportion takes longer, most of all with the softness of the tyres.
int rounds_of(const std::vector<Hypothesis>& hypotheses, int rounds) {
  const auto any = [&](const auto& is) { return std::any_of(hypotheses.begin(), hypotheses.end(), is); };
  if (any([](const Hypothesis& f) { return bool(f.with); })) return 2 * rounds;
  return any([](const Hypothesis& f) { return !f.from_zero; }) ? rounds + 1 : rounds;
}

}  // namespace

Fit Model::without(const Fit& whole, std::size_t out) const {
  std::vector<Hypothesis> hypotheses;
  std::vector<double> start;
  Eigen::Index at = 0;
  for (std::size_t i = 0; i < whole.hypotheses.size(); ++i) {
    const Eigen::Index n = Eigen::Index(whole.hypotheses[i].parameters.size());
    if (i != out) {
      hypotheses.push_back(whole.hypotheses[i]);
      start.insert(start.end(), whole.p.data() + at, whole.p.data() + at + n);
    }
    at += n;
  }
  return fit(hypotheses, Eigen::Map<Eigen::VectorXd>(start.data(), Eigen::Index(start.size())));
}

// Gauss-Newton on the density, with steps back where the simulator bends. Derivatives are taken where the descent
// begins, if none are given, and where it ends, if steps did not go where they pointed.
Fit Model::fit(const std::vector<Hypothesis>& hypotheses, const Eigen::VectorXd& start, int rounds,
               const std::vector<std::size_t>& some, const std::optional<Linearisation>& given) const {
  const std::vector<std::size_t> runs = some.empty() ? all_runs() : some;
  const std::vector<FreeParameter> free = free_parameters(hypotheses);
  const Eigen::Index m = Eigen::Index(free.size());
  const Eigen::VectorXd s = prior_sd_of(hypotheses);
  const std::vector<Eigen::VectorXd> sds = with_more(nuisance_sds(), s);
  const bool from_zero =
      std::all_of(hypotheses.begin(), hypotheses.end(), [](const Hypothesis& f) { return f.from_zero; });
  Fit fit;
  fit.hypotheses = hypotheses;
  fit.p.resize(m);
  for (Eigen::Index i = 0; i < m; ++i) fit.p[i] = start.size() == m ? start[i] : free[std::size_t(i)].start;
  Fit best;
  Descent d;
  d.known = given;
  const auto solved = [&](Fit& at) {
    at.columns = d.known->columns;
    at.grams = grams(residuals(at.predicted), at.columns);
    const Evidence e =
        evidence(at.grams, runs, first_columns(nuisances() + m), sds, after_nuisances(nuisances(), at.p));
    at.covariance = e.covariance.bottomRightCorner(m, m);
    return next_numbers(at, e.mean.tail(m), free, d);
  };
  const auto taken_here = [&](Fit& at) {
    d.known = linearised(at);
    d.learned = false;
  };
  for (int round = 0; round < rounds_of(hypotheses, rounds); ++round) {
    try {
      fit.predicted = predict({fit.effects()}).front();
      const std::vector<Eigen::VectorXd> there = residuals(fit.predicted);
      if (!d.known || (round == 0 && !d.known->foretold(fit.p, there))) {
        taken_here(fit);
      } else if (!d.known->foretold(fit.p, there)) {
        d.known->learn(fit.p, there, s);
        d.learned = true;
      }
    } catch (const std::runtime_error&) {
      // RunError or InputError: with these numbers the robot tips over, or does not even stand at its start. A step too
      // far, if it could be driven before.
      if (round == 0) throw;
      best.linear = false;
      fit.p = (fit.p + best.p) / 2;
      continue;
    }
    Eigen::VectorXd next = solved(fit);
    // Density with the effects held at p: the honest objective of the descent.
    const Evidence held = evidence(fit.grams, runs, first_columns(nuisances()), nuisance_sds());
    const double density = held.log_density - 0.5 * fit.p.cwiseQuotient(s).squaredNorm();
    fit.residual = held.residual;
    fit.misfit = held.misfit;
    fit.nuisance = held.mean;
    fit.prior = held.prior;
    if (density <= d.density) {
      // Where a step leads was not where the derivatives pointed, unless it was too small to matter.
      best.linear = density > d.density - 0.5;
      fit.p = (fit.p + best.p) / 2;
      continue;
    }
    bool ends = density < d.density + 0.05 || d.change < 0.1;
    d.density = density;
    if (ends && d.learned) {
      taken_here(fit);
      next = solved(fit);
      ends = d.change < 0.1;
    }
    best = fit;
    // At a bound the linear model may have its optimum far beyond it: that is no evidence, except for numbers that the
    // prior itself cuts at zero.
    best.linear = (from_zero ? d.change : d.wanted) < 1;
    if (ends) break;
    fit.p = next;
  }
  if (d.learned) {
    taken_here(best);
    solved(best);
  }
  best.log_chance = log_chance(best.effects());
  score(best);
  return best;
}

}  // namespace umbsim::gap
