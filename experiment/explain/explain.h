#pragma once

#include <map>
#include <string>
#include <vector>

#include "experiment/drive/run_digest.h"
#include "experiment/scenario/scenario.h"

namespace umbsim {

/// A mean return error, or a difference of two; in the frame of the start.
struct Contribution {
  double x_m = 0;
  double y_m = 0;
  double heading_rad = 0;
  double distance_m() const;
  Contribution operator+(const Contribution& other) const;
  Contribution operator-(const Contribution& other) const;
};

/// Contributions by direction; only those that are driven.
using Contributions = std::map<Direction, Contribution>;

/// What one effect of a scenario does to the return error.
struct ExplainedEffect {
  std::string name;
  Contributions alone;   ///< with this effect only, minus without any
  Contributions missed;  ///< the whole scenario minus the scenario without this effect
};

/// The first run of a direction as it was driven with some of the effects, for the page.
struct ExplainedRun {
  std::string with;  ///< "all effects", "no effect", or "wheelbase alone"
  std::string id;
  std::string direction;
  RunDigest digest;
};

/// Who causes how much of a scenario's return error.
struct Explanation {
  Contributions whole;     ///< the scenario as it is
  Contributions baseline;  ///< without any of its effects: noise, encoders, the odometry's beliefs
  std::vector<ExplainedEffect> effects;
  Contributions sum_alone;    ///< of all effects, each alone
  Contributions interaction;  ///< what is left: whole - baseline - sum_alone
  std::vector<ExplainedRun> runs;
};

/// Drives the scenario's plain squares with all of its effects, without any, with each alone and with all but each.
/// Noise is the scenario's own with the same seed in all of them, so that it cancels in the differences.
Explanation explain(const Scenario& scenario, int jobs);

}  // namespace umbsim
