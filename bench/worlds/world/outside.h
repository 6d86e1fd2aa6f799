#pragma once

#include <array>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "bench/worlds/engines/engine.h"
#include "gap/trial/draw/trial_plan.h"

namespace umbsim::worlds {

/// One moment of a run, as what acts from outside may look at it.
struct Moment {
  double time_s = 0;
  double slice_s = 0;  ///< until the next moment
  Pose2 X_WB;
  std::array<double, 2> wheel_rad{};
  std::array<double, 2> wheel_radps{};  ///< mean since the last moment
  std::array<double, 2> radius_m{};
  double wheelbase_m = 0;
  double weight_n = 0;

  double speed_mps() const { return (wheel_radps[0] * radius_m[0] + wheel_radps[1] * radius_m[1]) / 2; }
  double yaw_radps() const { return (wheel_radps[1] * radius_m[1] - wheel_radps[0] * radius_m[0]) / wheelbase_m; }
  bool moving() const;
};

/// What acts until the next moment. Several effects add up.
struct Acts {
  Pull pull;
  std::array<double, 2> rolling{1, 1};  ///< factors of the rolling radii
  std::array<double, 2> command{1, 1};  ///< factors of the set-points
  std::array<double, 2> counted{1, 1};  ///< counts for one that passes
  double drift_x = 0;                   ///< carpet
  double drift_y = 0;
};

/// Memory of one effect through one run.
struct Memory {
  RandomStream random;
  std::array<double, 4> value{};
};

/// An effect that the catalogue does not have: physics all the same, and the same in every engine.
struct OutsideInfo {
  std::string name;
  std::string text;  ///< one line
  std::string parameter;
  std::string unit;
  Range plausible;     ///< of the parameter: how strong it is
  bool place = false;  ///< acts in a disc: x_m, y_m, radius_m
  std::function<void(const std::map<std::string, double>& values, const Moment& now, Memory& memory, Acts& acts)> act;
};

/// The one table of effects outside the catalogue.
const std::vector<OutsideInfo>& outside_effects();
const OutsideInfo& find_outside(const std::string& name);

/// With its values: the strength, which wheel (0, 1), which sign, direction_rad, phase_rad, the disc.
struct OutsideEffect {
  const OutsideInfo* info = nullptr;
  std::map<std::string, double> values;
};

}  // namespace umbsim::worlds
