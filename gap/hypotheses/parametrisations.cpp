#include "gap/hypotheses/parametrisations.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace umbsim::gap {

std::size_t index_of(const EffectInfo& info, const std::string& parameter) {
  for (std::size_t i = 0; i < info.parameters.size(); ++i) {
    if (info.parameters[i].name == parameter) return i;
  }
  return 0;
}

Hypothesis direct(const std::string& effect, const std::string& variant, std::vector<FreeParameter> parameters,
                  const std::vector<std::pair<std::string, double>>& fixed) {
  Hypothesis hypothesis{effect, variant, std::move(parameters), {}, {}, true, 0};
  const EffectInfo& info = find_effect(effect);
  EffectValues base = neutral_effect(info).values;
  for (const auto& [name, value] : fixed) base.numbers[index_of(info, name)] = value;
  std::vector<std::size_t> where;
  for (FreeParameter& p : hypothesis.parameters) {
    where.push_back(index_of(info, p.name));
    const Bounds& bounds = info.parameters[where.back()].bounds;
    p.min = std::max(p.min, bounds.min);
    p.max = std::min(p.max, bounds.max);
  }
  hypothesis.values = [base, where](const Eigen::VectorXd& p) {
    EffectValues values = base;
    for (std::size_t i = 0; i < where.size(); ++i) values.numbers[where[i]] = p[Eigen::Index(i)];
    return values;
  };
  return hypothesis;
}

Hypothesis vector_hypothesis(const std::string& effect, const std::string& size, const std::string& angle, double step,
                             double prior_sd, double limit) {
  const EffectInfo& info = find_effect(effect);
  const EffectValues base = neutral_effect(info).values;
  const std::size_t i = index_of(info, size);
  const std::size_t j = index_of(info, angle);
  Hypothesis hypothesis{
      effect,
      size,
      {{size + " cos", 0, step, prior_sd, -limit, limit}, {size + " sin", 0, step, prior_sd, -limit, limit}},
      {},
      {},
      true,
      0};
  hypothesis.values = [base, i, j](const Eigen::VectorXd& p) {
    EffectValues values = base;
    values.numbers[i] = std::hypot(p[0], p[1]);
    values.numbers[j] = values.numbers[i] > 0 ? std::atan2(p[1], p[0]) : 0;
    return values;
  };
  return hypothesis;
}

Hypothesis logarithmic(const std::string& effect, const std::string& parameter, double unit, double prior_sd,
                       double min, double max) {
  const EffectInfo& info = find_effect(effect);
  const EffectValues base = neutral_effect(info).values;
  const std::size_t i = index_of(info, parameter);
  Hypothesis hypothesis{effect, parameter, {{"log " + parameter, 0, 0.05, prior_sd, min, max}}, {}, {}, true, 0};
  hypothesis.values = [base, i, unit](const Eigen::VectorXd& p) {
    EffectValues values = base;
    values.numbers[i] = unit * std::exp(p[0]);
    return values;
  };
  return hypothesis;
}

Hypothesis squared(const std::string& effect, const std::string& parameter, double step, double prior_sd, double most) {
  const EffectInfo& info = find_effect(effect);
  const EffectValues base = neutral_effect(info).values;
  const std::size_t i = index_of(info, parameter);
  if (most == 0) most = info.parameters[i].bounds.max;
  Hypothesis hypothesis{
      effect, parameter, {{fmt::format("{} squared", parameter), 0, step * step, prior_sd * prior_sd, 0, most * most}},
      {},     {},        true,
      0};
  hypothesis.values = [base, i](const Eigen::VectorXd& p) {
    EffectValues values = base;
    values.numbers[i] = std::sqrt(std::max(p[0], 0.0));
    return values;
  };
  return hypothesis;
}

}  // namespace umbsim::gap
