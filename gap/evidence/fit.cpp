// Fits, and fitting the numbers of effects in the simulator.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "gap/evidence/model.h"

namespace umbsim::gap {

namespace {

constexpr int kRoundsOnFewer = 3;

}  // namespace

// One descent to the best numbers: what is known of the derivatives, and of the step to come.
struct Model::Descent {
  std::optional<Linearisation> known;
  bool learned = false;  // from steps, since they were last taken at a point
  double density = -1e300;
  double wanted = 0;  // the next step in standard deviations, without bounds
  double change = 0;  // and within them

  // Where the linear model has its optimum, within the bounds.
  Eigen::VectorXd next_numbers(const Fit& fit, const Eigen::VectorXd& optimum, const std::vector<FreeParameter>& free) {
    Eigen::VectorXd next = optimum;
    change = wanted = 0;
    for (Eigen::Index i = 0; i < next.size(); ++i) {
      const double sd_left = std::sqrt(fit.covariance(i, i) + 1e-300);
      wanted = std::max(wanted, std::abs(next[i] - fit.p[i]) / sd_left);
      next[i] = std::clamp(next[i], free[std::size_t(i)].min, free[std::size_t(i)].max);
      change = std::max(change, std::abs(next[i] - fit.p[i]) / sd_left);
    }
    return next;
  }
};

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

Eigen::VectorXd start_of(const std::vector<Hypothesis>& hypotheses) {
  const std::vector<FreeParameter> free = free_parameters(hypotheses);
  Eigen::VectorXd start(Eigen::Index(free.size()));
  for (Eigen::Index i = 0; i < start.size(); ++i) start[i] = free[std::size_t(i)].start;
  return start;
}

// What does not act in proportion takes longer, most of all with the softness of the tyres.
int rounds_of(const std::vector<Hypothesis>& hypotheses, int rounds) {
  const auto any = [&](const auto& is) { return std::any_of(hypotheses.begin(), hypotheses.end(), is); };
  if (any([](const Hypothesis& f) { return bool(f.with); })) return 2 * rounds;
  return any([](const Hypothesis& f) { return !f.from_zero; }) ? rounds + 1 : rounds;
}

}  // namespace

void Model::take_derivatives(const Fit& at, Descent& d) const {
  d.known = linearised(at);
  d.learned = false;
}

// Beside these numbers the robot may tip over, both ways: then what the descent has learned serves.
void Model::take_derivatives_again(const Fit& at, Descent& d) const {
  try {
    take_derivatives(at, d);
  } catch (const std::runtime_error&) {  // RunError or InputError
    d.learned = false;
  }
}

Eigen::VectorXd Model::solve(Fit& at, const std::vector<std::size_t>& runs, const Descent& d) const {
  const Eigen::Index m = at.p.size();
  at.columns = d.known->columns;
  at.grams = grams(residuals(at.predicted), at.columns);
  const Evidence e =
      evidence(at.grams, runs, first_columns(nuisances() + m), with_more(nuisance_sds(), prior_sd_of(at.hypotheses)),
               after_nuisances(nuisances(), at.p));
  at.covariance = e.covariance.bottomRightCorner(m, m);
  return e.mean.tail(m);
}

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
// begins, if none are given, and, if `sure`, where it ends, if steps did not go where they pointed.
Fit Model::descend(const std::vector<Hypothesis>& hypotheses, const Eigen::VectorXd& start,
                   const Descending& descending, const std::vector<std::size_t>& runs, Descent& d, bool sure) const {
  const std::vector<FreeParameter> free = free_parameters(hypotheses);
  const Eigen::VectorXd s = prior_sd_of(hypotheses);
  const bool from_zero =
      std::all_of(hypotheses.begin(), hypotheses.end(), [](const Hypothesis& f) { return f.from_zero; });
  Fit fit;
  fit.hypotheses = hypotheses;
  fit.p = start.size() == s.size() ? start : start_of(hypotheses);
  Fit best;
  for (int round = 0; round < rounds_of(hypotheses, descending.rounds); ++round) {
    try {
      fit.predicted = predict({fit.effects()}).front();
      const std::vector<Eigen::VectorXd> there = residuals(fit.predicted);
      if (!d.known || (round == 0 && !d.known->foretold(fit.p, there))) {
        take_derivatives(fit, d);
      } else if (!d.known->foretold(fit.p, there)) {
        d.known->learn(fit.p, there, s);
        d.learned = true;
      }
    } catch (const std::runtime_error&) {
      // RunError or InputError: with these numbers the robot tips over, or does not even stand at its start. A step too
      // far, if it could be driven before.
      if (round == 0) throw;
      best.linear = false;
      fit.p = best.p + descending.back * (fit.p - best.p);
      continue;
    }
    Eigen::VectorXd next = d.next_numbers(fit, solve(fit, runs, d), free);
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
      fit.p = best.p + descending.back * (fit.p - best.p);
      continue;
    }
    bool ends = density < d.density + 0.05 || d.change < 0.1;
    d.density = density;
    if (ends && d.learned && sure) {
      take_derivatives_again(fit, d);
      next = d.next_numbers(fit, solve(fit, runs, d), free);
      ends = d.change < 0.1;
    }
    best = fit;
    // At a bound the linear model may have its optimum far beyond it: that is no evidence, except for numbers that the
    // prior itself cuts at zero.
    best.linear = (from_zero ? d.change : d.wanted) < 1;
    if (ends) break;
    fit.p = next;
  }
  return best;
}

Fit Model::fit(const std::vector<Hypothesis>& hypotheses, const Eigen::VectorXd& start, const Descending& descending,
               const std::vector<std::size_t>& some, const std::optional<Linearisation>& known) const {
  const std::vector<std::size_t> runs = some.empty() ? all_runs() : some;
  Descent d{known};
  Fit best = descend(hypotheses, start, descending, runs, d, true);
  if (d.learned) {
    take_derivatives_again(best, d);
    solve(best, runs, d);
  }
  best.log_chance = log_chance(best.effects());
  score(best);
  return best;
}

Eigen::VectorXd Model::numbers_on(const Fit& fit, const std::vector<std::size_t>& runs) const {
  const Eigen::VectorXd shift = after_nuisances(nuisances(), fit.p);
  const Eigen::VectorXd s = prior_sd_of(fit.hypotheses);
  const Evidence e = evidence(fit.grams, runs, first_columns(shift.size()), with_more(nuisance_sds(), s), shift);
  Eigen::VectorXd numbers = e.mean.tail(fit.p.size());
  Eigen::Index i = 0;
  bool all_told = true;
  for (const FreeParameter& p : free_parameters(fit.hypotheses)) {
    // What happened in one run alone no other run can tell: the number stays as it is.
    const double sd_left = std::sqrt(e.covariance(nuisances() + i, nuisances() + i));
    const bool told = sd_left < 0.8 * p.prior_sd;
    if (!told) numbers[i] = fit.p[i];
    all_told = all_told && told;
    numbers[i] = std::clamp(numbers[i], p.min, p.max);
    ++i;
  }
  if (fit.linear || !all_told) return numbers;
  // Where the simulator bends the derivatives may point off the hill: the descent steps back then.
  Descent d{Linearisation{fit.p, residuals(fit.predicted), fit.columns}};
  return descend(fit.hypotheses, fit.p, {kRoundsOnFewer}, runs, d, false).p;
}

}  // namespace umbsim::gap
