// What a fit is, and is worth: log evidence, over all runs or some.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <stdexcept>

#include "core/probability.h"
#include "gap/evidence/model.h"
#include "gap/noise/lost_by_chance.h"

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

double Fit::own_evidence() const {
  const Hypothesis& last = hypotheses.back();
  const Eigen::Index all = Eigen::Index(last.parameters.size()), own = all - last.of_others;
  const Eigen::Index at = p.size() - all;
  const Eigen::MatrixXd S = covariance.block(at, at, own, own);
  const Eigen::VectorXd m = p.segment(at, own);
  const Eigen::LDLT<Eigen::MatrixXd> solver(S);
  double log_det = solver.vectorD().array().log().sum();
  for (Eigen::Index i = 0; i < own; ++i) log_det -= 2 * std::log(last.parameters[std::size_t(i)].prior_sd);
  return 0.5 * (m.dot(solver.solve(m)) + log_det);
}

bool Fit::is_kinematic() const {
  return std::all_of(hypotheses.begin(), hypotheses.end(),
                     [](const Hypothesis& f) { return gap::is_kinematic(f.effect); });
}

bool Fit::is_local() const {
  return std::any_of(hypotheses.begin(), hypotheses.end(), [](const Hypothesis& f) { return f.search_cost > 0; });
}

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
  const Eigen::VectorXd shift = after_nuisances(nuisances(), fit.p);
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
  fit.residual = e.residual;
  fit.misfit = e.misfit;
  fit.nuisance = e.mean;
  fit.prior = e.prior;
  return fit;
}

double Model::held_density(const Fit& fit, const std::vector<std::size_t>& some) const {
  const std::vector<std::size_t> runs = some.empty() ? all_runs() : some;
  return evidence(grams(residuals(fit.predicted), {}), runs, first_columns(nuisances()), nuisance_sds()).log_density;
}

double Model::density_at(const std::vector<Hypothesis>& hypotheses, const Eigen::VectorXd& p,
                         const std::vector<std::size_t>& some) const {
  Fit fit;
  fit.hypotheses = hypotheses;
  fit.p = p;
  fit.predicted = predict({fit.effects()}, some).front();
  return held_density(fit, some) + log_chance(fit.effects());
}

double Model::another_engine(const Fit& fit) const {
  if (!engine_is_open()) return 0;
  const auto density = [&](auto from, auto to) {
    return evidence(fit.grams, all_runs(), first_columns(nuisances()), std::vector<Eigen::VectorXd>(from, to))
        .log_density;
  };
  const auto begin = nuisance_sds().begin(), same = begin + std::ptrdiff_t(nuisances_.of_another);
  return density(begin, same) - density(same, nuisance_sds().end());
}

Model Model::with_little_differences() const {
  Model little = *this;
  Nuisances& n = little.nuisances_;
  n.shared_sds.erase(n.shared_sds.begin(), n.shared_sds.begin() + std::ptrdiff_t(n.wide));
  n.of_another -= n.wide;
  n.wide = 0;
  return little;
}

Model Model::with_turns_alike() const {
  Model alike = *this;
  for (Eigen::VectorXd& sd : alike.nuisances_.shared_sds) sd(nuisances_.turns).setConstant(scatter_.turn_scale);
  return alike;
}

void Model::take_for_another_engines() {
  nuisances_.shared_sds.resize(nuisances_.wide);
  nuisances_.of_another = nuisances_.wide;
}

}  // namespace umbsim::gap
