#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "gap/plan/plan.h"

namespace umbsim::gap {

/// What a plan's indices stand for.
struct PlanContext {
  std::string title;
  std::vector<std::string> labels;  ///< of all runs: those that are asked about, then the menu
  std::vector<double> durations_s;
  std::size_t given = 0;
  std::vector<std::string> limits;
};

/// plan.json (format umbsim-gap-plan/1).
nlohmann::ordered_json plan_json(const Plan& plan, const PlanContext& context, const PlanOptions& options,
                                 const NoiseModel& noise);

/// The same for a reader at a terminal. `matrix`: with all of what would be named for what.
std::string plan_text(const Plan& plan, const PlanContext& context, const PlanOptions& options, bool matrix);

}  // namespace umbsim::gap
