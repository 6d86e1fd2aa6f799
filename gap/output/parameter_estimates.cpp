#include "gap/output/parameter_estimates.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "gap/traits/number_errors.h"
#include "gap/traits/traits.h"

namespace umbsim::gap {
namespace {

constexpr int kParameterDraws = 2000;
// What a replay is off by that no residual shows, standard deviations, from development trials (docs/gap-method.md).
constexpr double kReplayShare = 0.03;  // of a size, against its neutral value
constexpr double kScrubShare =
    0.08;  // of what scrubs: the floor's roughness, which lets wheels slip, is known to a fifth
constexpr double kReplayAngle_rad = 0.01;
constexpr double kReplayPlace_m = 0.005;
constexpr double kReplayMoment_s = 0.01;

bool is_angle(const EffectParameter& p) { return p.unit == "rad" && p.bounds.min <= -3 && p.bounds.max >= 3; }

/// How far from a value its truth may be, besides noise: half of a 95 % interval.
struct Reach {
  double below = 0, above = 0;
};

Reach replay_reach(const std::string& effect, const EffectParameter& p, double value, bool elsewhere) {
  const auto even = [](double sd) { return Reach{1.96 * sd, 1.96 * sd}; };
  if (is_angle(p)) return even(elsewhere ? kAngleElsewhere_rad : kReplayAngle_rad);
  if (p.name == "x_m" || p.name == "y_m") return even(elsewhere ? kPlaceElsewhere_m : kReplayPlace_m);
  if (p.name == "leg") return {};
  if (p.name == "seconds_into_leg") return even(elsewhere ? kMomentElsewhere_s : kReplayMoment_s);
  const NumberError other = elsewhere ? number_error_of(effect) : NumberError{};
  const double log_sd = std::hypot(is(effect, kScrubs) ? kScrubShare : kReplayShare, other.log);
  const double size = value - p.neutral;
  const Reach share{std::abs(size) * -std::expm1(-1.96 * log_sd), std::abs(size) * std::expm1(1.96 * log_sd)};
  const double time = p.unit == "s" ? 1.96 * other.time_s : 0;
  return {std::hypot(size < 0 ? share.above : share.below, time),
          std::hypot(size < 0 ? share.below : share.above, time)};
}

}  // namespace

// Draws from the posterior, seen through the hypothesis's own coordinates.
std::vector<ParameterEstimate> parameter_estimates(const Fit& fit, const Diagnosis& d) {
  std::vector<ParameterEstimate> estimates;
  if (fit.hypotheses.empty()) return estimates;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(fit.covariance * d.overdispersion);
  const Eigen::MatrixXd root = eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
  RandomStream random(1, "parameter intervals");
  std::vector<Eigen::VectorXd> draws;
  for (int i = 0; i < kParameterDraws; ++i) {
    Eigen::VectorXd z(fit.p.size());
    for (Eigen::Index j = 0; j < z.size(); ++j) z[j] = random.normal();
    draws.push_back(fit.p + root * z);
  }
  Eigen::Index at = 0;
  for (const Hypothesis& f : fit.hypotheses) {
    const Eigen::Index n = Eigen::Index(f.parameters.size());
    const EffectInfo& info = find_effect(f.effect);
    const EffectValues best = f.values(fit.p.segment(at, n));
    const EffectValues neutral = neutral_effect(info).values;
    for (std::size_t k = 0; k < info.parameters.size(); ++k) {
      std::vector<double> values;
      for (const Eigen::VectorXd& draw : draws) {
        double v = f.values(draw.segment(at, n)).numbers[k];
        if (is_angle(info.parameters[k])) v = best.numbers[k] + std::remainder(v - best.numbers[k], 2 * M_PI);
        values.push_back(v);
      }
      std::sort(values.begin(), values.end());
      const bool fixed = values.front() == values.back();
      if (fixed && best.numbers[k] == neutral.numbers[k]) continue;
      const double best_k = best.numbers[k];
      const Reach reach = replay_reach(f.effect, info.parameters[k], best_k, d.elsewhere);
      const Bounds possible = is_angle(info.parameters[k]) ? Bounds{} : info.parameters[k].bounds;
      const double low = best_k - std::hypot(best_k - values[kParameterDraws / 40], reach.below);
      const double high = best_k + std::hypot(values[kParameterDraws - 1 - kParameterDraws / 40] - best_k, reach.above);
      estimates.push_back(
          {f.effect,
           info.parameters[k].name,
           info.parameters[k].unit,
           best_k,
           {std::max(std::min(best_k, possible.min), low), std::min(std::max(best_k, possible.max), high)}});
    }
    at += n;
  }
  return estimates;
}

std::vector<ParameterEstimate> parameter_estimates(const Cause& cause, const Diagnosis& d) {
  std::vector<ParameterEstimate> estimates = parameter_estimates(cause.fit, d);
  for (const Fit& variant : cause.variants) {
    for (const ParameterEstimate& v : parameter_estimates(variant, d)) {
      const EffectInfo& info = find_effect(v.effect);
      const auto parameter = std::find_if(info.parameters.begin(), info.parameters.end(),
                                          [&](const EffectParameter& p) { return p.name == v.parameter; });
      if (is_angle(*parameter)) continue;  // of what may not be there
      const auto same = [&](const ParameterEstimate& e) { return e.effect == v.effect && e.parameter == v.parameter; };
      auto at = std::find_if(estimates.begin(), estimates.end(), same);
      if (at == estimates.end()) {
        const double neutral = parameter->neutral;
        at = estimates.insert(at, {v.effect, v.parameter, v.unit, neutral, {neutral, neutral}});
      }
      at->ci95[0] = std::min(at->ci95[0], v.ci95[0]);
      at->ci95[1] = std::max(at->ci95[1], v.ci95[1]);
    }
  }
  return estimates;
}

std::vector<ParameterEstimate> effective_dimensions(const Diagnosis& d) {
  std::vector<ParameterEstimate> found;
  if (!d.effective) return found;
  const auto& names = d.effective->dimensions;
  for (const ParameterEstimate& e : parameter_estimates(d.effective->fit, d)) {
    if (std::find(names.begin(), names.end(), e.effect) != names.end()) found.push_back(e);
  }
  return found;
}

FoundParameter found(const ParameterEstimate& e) { return {e.parameter, e.value, e.ci95[0], e.ci95[1]}; }

std::string shown_text(const ParameterEstimate& e) {
  const EffectInfo& info = find_effect(e.effect);
  return is_neutral(info, found(e)) ? "" : shown(info, found(e));
}

}  // namespace umbsim::gap
