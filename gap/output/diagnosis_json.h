#pragma once

#include <nlohmann/json.hpp>

#include "effects/words.h"
#include "gap/answer/diagnosis.h"

namespace umbsim::gap {

/// diagnosis.json (format umbsim-diagnosis/1). `verdict`, `cost` and `next_experiment` are added by the caller.
nlohmann::ordered_json diagnosis_json(const Diagnosis& diagnosis);

/// Value and 95 % interval of every fitted number of a cause, in the catalogue's parameters.
struct ParameterEstimate {
  std::string effect;
  std::string parameter;
  std::string unit;
  double value = 0;
  double ci95[2] = {0, 0};
};
std::vector<ParameterEstimate> parameter_estimates(const Fit& fit, double overdispersion);

/// The same of a cause: the values of its fit, with intervals that hold those of its variants, too. A number that the
/// fit keeps neutral and a variant sets free is listed with its neutral value.
std::vector<ParameterEstimate> parameter_estimates(const Cause& cause, double overdispersion);

/// Of the radii and wheelbase that stand in the twin for what the causes leave.
std::vector<ParameterEstimate> effective_dimensions(const Diagnosis& d);

FoundParameter found(const ParameterEstimate& estimate);

/// What a reader sees of it, on the terminal and on the page; empty where it stayed neutral.
std::string shown_text(const ParameterEstimate& estimate);

}  // namespace umbsim::gap
