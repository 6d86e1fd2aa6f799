#pragma once

#include <string>

#include "odometry/dead_reckoning.h"
#include "umbmark/figures.h"

namespace umbsim {

enum class CalibrationMethod { endpoint, heading };

inline const ErrorEstimate& estimate(const Umbmark& u, CalibrationMethod method) {
  return method == CalibrationMethod::endpoint ? u.endpoint : u.heading;
}

const char* name(CalibrationMethod method);

/// When to trust this form's corrections, in one line.
const char* when_to_trust(CalibrationMethod method);

/// The odometry with the corrections of Borenstein & Feng 1996: radii times c_L and c_R (their mean stays), wheelbase
/// times E_b.
OdometryParameters corrected(const OdometryParameters& odometry, const ErrorEstimate& errors);

/// calibration.yaml: an `odometry:` block, ready to be put into a scenario.
std::string calibration_yaml(const OdometryParameters& odometry, const std::string& comment);

}  // namespace umbsim
