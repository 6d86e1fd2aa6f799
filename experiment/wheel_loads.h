#pragma once

#include <array>
#include <string>
#include <vector>

#include "experiment/run.h"

namespace umbsim {

/// How a wheel was loaded in all runs of an experiment, those after calibration too.
struct WheelLoads {
  double least_n = 0;
  double mean_n = 0;          ///< over time
  double unloaded_share = 0;  ///< of the time
  double longest_unloaded_s = 0;
  int unloaded_runs = 0;    ///< runs in which it carried nothing for longer than kUnloaded_s
  std::string longest_run;  ///< in which, and from when on
  double longest_from_s = 0;
};

/// Longer than this is more than a moment. An odometry counts on while its wheel hangs.
constexpr double kUnloaded_s = 0.1;

/// Left, right.
std::array<WheelLoads, 2> wheel_loads(const ExperimentResult& result);

/// What was out of order in the runs: wheels without load, headings more than a radian off and why, steps that the
/// solver could not solve.
std::vector<std::string> run_warnings(const ExperimentResult& result);

}  // namespace umbsim
