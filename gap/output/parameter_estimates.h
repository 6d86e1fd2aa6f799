#pragma once

#include <string>
#include <vector>

#include "effects/words.h"
#include "gap/answer/diagnosis.h"

namespace umbsim::gap {

/// Value and 95 % interval of every fitted number of a cause, in the catalogue's parameters. The interval holds noise,
/// nuisances and what a replay is off by; of a recording that this simulator did not make, also by how much the same
/// effect comes out otherwise elsewhere (traits/number_errors.h).
struct ParameterEstimate {
  std::string effect;
  std::string parameter;
  std::string unit;
  double value = 0;
  double ci95[2] = {0, 0};
};
std::vector<ParameterEstimate> parameter_estimates(const Fit& fit, const Diagnosis& d);

/// The same of a cause: the values of its fit, with intervals that hold those of its variants, too. A number that the
/// fit keeps neutral and a variant sets free is listed with its neutral value.
std::vector<ParameterEstimate> parameter_estimates(const Cause& cause, const Diagnosis& d);

/// Of the radii and wheelbase that stand in the twin for what the causes leave.
std::vector<ParameterEstimate> effective_dimensions(const Diagnosis& d);

FoundParameter found(const ParameterEstimate& estimate);

/// What a reader sees of it, on the terminal and on the page; empty where it stayed neutral.
std::string shown_text(const ParameterEstimate& estimate);

}  // namespace umbsim::gap
