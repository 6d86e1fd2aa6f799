#include "gap/evidence/drivable.h"

#include <algorithm>
#include <stdexcept>

namespace umbsim::gap {
namespace {

std::vector<std::vector<Effect>> stepped(const Family& family) {
  if (!family.from_zero) return {effects_of(family, start_of(family))};
  std::vector<std::vector<Effect>> all;
  for (Eigen::Index i = 0; i < Eigen::Index(family.parameters.size()); ++i) {
    Eigen::VectorXd p = start_of(family);
    p[i] += family.parameters[std::size_t(i)].step;
    all.push_back(effects_of(family, p));
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

bool adapt_steps(const Model& model, Family& family) {
  if (!family.from_zero) return can_be_driven(model, stepped(family));
  for (std::size_t i = 0; i < family.parameters.size(); ++i) {
    FreeParameter& parameter = family.parameters[i];
    const double whole = parameter.step;
    bool found = false;
    for (const double share : {1.0, -1.0, 1.0 / 4, -1.0 / 4, 1.0 / 16, -1.0 / 16, 1.0 / 64, -1.0 / 64}) {
      const double at = parameter.start + share * whole;
      if (at < parameter.min || at > parameter.max) continue;
      parameter.step = share * whole;
      found = can_be_driven(model, {stepped(family)[i]});
      if (found) break;
    }
    if (!found) return false;
  }
  return true;
}

}  // namespace

std::vector<Family> drivable(const Model& model, std::vector<Family> families) {
  std::vector<std::vector<Effect>> all;
  for (const Family& f : families) {
    for (std::vector<Effect>& effects : stepped(f)) all.push_back(std::move(effects));
  }
  if (can_be_driven(model, all)) return families;
  std::erase_if(families, [&](Family& f) { return !adapt_steps(model, f); });
  return families;
}

}  // namespace umbsim::gap
