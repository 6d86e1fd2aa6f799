#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibration/methods/fit.h"

namespace umbsim::calibration {

/// What one kind of part of the course says, from headings and counts alone. Intervals by the jackknife over runs.
struct PartFit {
  std::string recording;
  std::string part;  ///< "whole runs", "turns, straight to straight", "legs", "curves"
  std::size_t pieces = 0;
  std::optional<Estimate> e_d;
  std::optional<Estimate> e_b;
  double degrees_of_freedom = 0;
};

/// How the recorded start heading stands to the first straight of one run.
struct StartHeading {
  std::string recording, run;
  double off_rad = 0;    ///< tracked minus counted turn from the start to the middle of the first leg
  double usual_rad = 0;  ///< the same of the later legs, from their start to their middle: robust spread
};

struct Parts {
  std::vector<PartFit> fits;
  std::vector<StartHeading> starts;
  std::vector<std::string> warnings;  ///< parts that disagree beyond their intervals, starts that stand out
};

/// Of all recordings with tracks. Parts of one recording are compared with each other, curves and turns of several
/// recordings, too.
Parts fit_parts(const Runs& runs, const std::vector<std::string>& names, const OdometryParameters& nominal);

}  // namespace umbsim::calibration
