#include "gap/search/drivable.h"

#include <algorithm>
#include <stdexcept>

namespace umbsim::gap {
namespace {

std::vector<std::vector<Effect>> stepped(const Hypothesis& hypothesis) {
  if (!hypothesis.from_zero) return {effects_of(hypothesis, start_of(hypothesis))};
  std::vector<std::vector<Effect>> all;
  for (Eigen::Index i = 0; i < Eigen::Index(hypothesis.parameters.size()); ++i) {
    Eigen::VectorXd p = start_of(hypothesis);
    p[i] += hypothesis.parameters[std::size_t(i)].step;
    all.push_back(effects_of(hypothesis, p));
  }
  return all;
}

bool can_be_driven(const Model& model, const std::vector<std::vector<Effect>>& sets) {
  try {
    model.predict(sets);
  } catch (const std::runtime_error&) {  // RunError or InputError
    return false;
  }
  return true;
}

bool adapt_steps(const Model& model, Hypothesis& hypothesis) {
  if (!hypothesis.from_zero) return can_be_driven(model, stepped(hypothesis));
  for (std::size_t i = 0; i < hypothesis.parameters.size(); ++i) {
    FreeParameter& parameter = hypothesis.parameters[i];
    const double whole = parameter.step;
    bool found = false;
    for (const double share : {1.0, -1.0, 1.0 / 4, -1.0 / 4, 1.0 / 16, -1.0 / 16, 1.0 / 64, -1.0 / 64}) {
      const double at = parameter.start + share * whole;
      if (at < parameter.min || at > parameter.max) continue;
      parameter.step = share * whole;
      found = can_be_driven(model, {stepped(hypothesis)[i]});
      if (found) break;
    }
    if (!found) return false;
  }
  return true;
}

}  // namespace

std::vector<Hypothesis> drivable(const Model& model, std::vector<Hypothesis> hypotheses) {
  std::vector<std::vector<Effect>> all;
  for (const Hypothesis& f : hypotheses) {
    for (std::vector<Effect>& effects : stepped(f)) all.push_back(std::move(effects));
  }
  if (can_be_driven(model, all)) return hypotheses;
  std::erase_if(hypotheses, [&](Hypothesis& f) { return !adapt_steps(model, f); });
  return hypotheses;
}

}  // namespace umbsim::gap
