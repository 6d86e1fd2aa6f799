#pragma once

#include <string>
#include <vector>

#include "calibration/methods/fit.h"

namespace umbsim::calibration {

/// One way to calibrate, in words and as a function.
struct Method {
  const char* name;
  const char* title;
  const char* source;
  const char* takes_for_exact;  ///< assumptions
  const char* cannot_see;
  Fit (*fit)(const Runs&, const OdometryParameters&);
};

/// The visible table of all methods.
const std::vector<Method>& methods();

/// With its interval. Throws NotApplicable.
Fit fit_with(const Method& method, const Runs& runs, const OdometryParameters& nominal);

}  // namespace umbsim::calibration
