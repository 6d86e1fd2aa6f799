#pragma once

#include <string>
#include <vector>

#include "recording/recording.h"

namespace umbsim::gap {

/// One run that an experimenter may be asked to drive.
struct MenuRun {
  std::string label;   ///< in words, with its direction
  RecordedRun run;     ///< header without data
  double dwell_s = 0;  ///< standstill after every leg and turn
  double angular_speed_radps = 0;
};

/// Runs that a scenario can describe, each cw and ccw: plain, started a quarter turn round, fast, slow, with a payload,
/// with rolling turns, with fast turns, with long standstills. Reverse driving and spins are not among them: no course
/// has them. `path`: the plain square. `dwell_s`: of the plain square.
std::vector<MenuRun> plan_menu(const RecordedPath& path, double dwell_s, double payload_kg);

}  // namespace umbsim::gap
