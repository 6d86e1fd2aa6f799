// Fitting the numbers of effects in the simulator, and what a fit is worth.
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "gap/evidence/model.h"
#include "gap/noise/lost_by_chance.h"

namespace umbsim::gap {
namespace {

constexpr int kRoundsAgain = 2;

// The derivatives are taken at the fitted numbers: as a shift of the linear model's parameters.
Eigen::VectorXd shifted(int nuisances, const Eigen::VectorXd& p) {
  Eigen::VectorXd shift = Eigen::VectorXd::Zero(nuisances + p.size());
  shift.tail(p.size()) = p;
  return shift;
}

}  // namespace

// Whatever else makes the noise, it is not less than what chance makes.
double Model::log_chance(const std::vector<Effect>& effects) const {
  const NoiseModel chance = lost_by_chance(nominal_, effects);
  double sum = 0;
  for (const NoiseEstimate& estimate : noises_) {
    if (!estimate.log_likelihood) continue;
    NoiseModel noise = estimate.noise;
    noise.heading_rad2_pm = std::max(noise.heading_rad2_pm, chance.heading_rad2_pm);
    noise.along_m2_pm = std::max(noise.along_m2_pm, chance.along_m2_pm);
    const bool less =
        noise.heading_rad2_pm <= estimate.noise.heading_rad2_pm && noise.along_m2_pm <= estimate.noise.along_m2_pm;
    if (!less) sum += std::min(0.0, estimate.log_likelihood(noise) - estimate.log_likelihood(estimate.noise));
  }
  return sum;
}

double Model::log_evidence(const Fit& fit, const std::vector<std::size_t>& runs) const {
  const Eigen::VectorXd shift = shifted(nuisances(), fit.p);
  const Eigen::VectorXd s = prior_sd_of(fit.hypotheses);
  const Evidence e = evidence(fit.grams, runs, first_columns(shift.size()), with_more(nuisance_sds(), s), shift);
  double cost = -fit.log_chance;
  for (const Hypothesis& f : fit.hypotheses) cost += f.search_cost + f.variant_cost;
  if (!fit.linear) {
    // The simulator bends: the density where the descent ended, and the width that the derivatives give there.
    double log_density = evidence(fit.grams, runs, first_columns(nuisances()), nuisance_sds()).log_density;
    const Eigen::MatrixXd width = e.covariance.bottomRightCorner(s.size(), s.size());
    log_density += 0.5 * std::log(std::max(1e-300, width.determinant())) - s.array().log().sum();
    return log_density - 0.5 * fit.p.cwiseQuotient(s).squaredNorm() - cost;
  }
  double log_density = e.log_density - cost;
  // A number that cannot be negative has half a normal for its prior.
  Eigen::Index i = nuisances();
  for (const FreeParameter& p : free_parameters(fit.hypotheses)) {
    if (p.min >= 0) log_density += log_normal_cdf(e.mean[i] / std::sqrt(e.covariance(i, i))) + std::log(2.0);
    ++i;
  }
  return log_density;
}

Eigen::VectorXd Model::numbers_on(const Fit& fit, const std::vector<std::size_t>& runs) const {
  const Eigen::VectorXd shift = shifted(nuisances(), fit.p);
  const Eigen::VectorXd s = prior_sd_of(fit.hypotheses);
  const Evidence e = evidence(fit.grams, runs, first_columns(shift.size()), with_more(nuisance_sds(), s), shift);
  Fit other = fit;
  other.p = e.mean.tail(fit.p.size());
  Eigen::Index i = 0;
  bool all_told = true;
  for (const FreeParameter& p : free_parameters(fit.hypotheses)) {
    // What happened in one run alone no other run can tell: the number stays as it is.
    const double sd_left = std::sqrt(e.covariance(nuisances() + i, nuisances() + i));
    const bool told = sd_left < 0.8 * p.prior_sd;
    if (!told) other.p[i] = fit.p[i];
    all_told = all_told && told;
    other.p[i] = std::clamp(other.p[i], p.min, p.max);
    ++i;
  }
  if (fit.linear || !all_told) return other.p;
  // Where the simulator bends the derivatives may point off the hill: the better of both starts.
  const auto density = [&](const Eigen::VectorXd& p) {
    try {
      return density_at(fit.hypotheses, p, runs);
    } catch (const std::runtime_error&) {
      return -1e300;  // it cannot be driven so
    }
  };
  const bool astray = density(fit.p) > density(other.p);
  return this->fit(fit.hypotheses, astray ? fit.p : other.p, kRoundsAgain, runs).p;
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

void Model::score(Fit& fit) const {
  const std::vector<std::size_t> all = all_runs();
  fit.log_evidence = log_evidence(fit, all);
  fit.held_out = 0;
  std::set<std::string> conditions;
  for (std::size_t r : all) conditions.insert(condition(r));
  for (const std::string& c : conditions) {
    std::vector<std::size_t> rest;
    for (std::size_t r : all) {
      if (condition(r) != c) rest.push_back(r);
    }
    if (!rest.empty()) fit.held_out += fit.log_evidence - log_evidence(fit, rest);
  }
}

Fit Model::none() const {
  Fit fit;
  fit.p.resize(0);
  fit.covariance.resize(0, 0);
  fit.predicted = without_effects_;
  fit.grams = grams(residuals(without_effects_), {});
  const Evidence e = evidence(fit.grams, all_runs(), first_columns(nuisances()), nuisance_sds());
  fit.residual = e.residual;
  fit.misfit = e.misfit;
  fit.nuisance = e.mean;
  fit.prior = e.prior;
  score(fit);
  return fit;
}

Fit Model::held(Fit fit) const {
  const Evidence e =
      evidence(grams(residuals(fit.predicted), {}), all_runs(), first_columns(nuisances()), nuisance_sds());
  fit.nuisance = e.mean;
  fit.prior = e.prior;
  return fit;
}

double Model::density_at(const std::vector<Hypothesis>& hypotheses, const Eigen::VectorXd& p,
                         const std::vector<std::size_t>& some) const {
  Fit fit;
  fit.hypotheses = hypotheses;
  fit.p = p;
  const std::vector<std::size_t> runs = some.empty() ? all_runs() : some;
  const Predicted predicted = predict({fit.effects()}, runs).front();
  return evidence(grams(residuals(predicted), {}), runs, first_columns(nuisances()), nuisance_sds()).log_density +
         log_chance(fit.effects());
}

// Derivatives at the fit's numbers, by a step in every direction.
Linearisation Model::linearised(const Fit& fit) const {
  const std::vector<FreeParameter> free = free_parameters(fit.hypotheses);
  std::vector<std::vector<Effect>> sets;
  std::vector<double> steps;
  for (Eigen::Index i = 0; i < fit.p.size(); ++i) {
    const FreeParameter& parameter = free[std::size_t(i)];
    Fit stepped;
    stepped.hypotheses = fit.hypotheses;
    stepped.p = fit.p;
    steps.push_back(fit.p[i] + parameter.step > parameter.max ? -parameter.step : parameter.step);
    stepped.p[i] += steps.back();
    sets.push_back(stepped.effects());
  }
  return {fit.p, residuals(fit.predicted), columns(fit.predicted, predict(sets), steps)};
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
    const Evidence e = evidence(at.grams, runs, first_columns(nuisances() + m), sds, shifted(nuisances(), at.p));
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
