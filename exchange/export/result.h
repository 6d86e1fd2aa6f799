#pragma once

#include <map>
#include <optional>
#include <string>

#include "odometry/dead_reckoning.h"
#include "odometry/uncertainty.h"
#include "recording/recording.h"

namespace umbsim::exchange {

/// Both ends of a 95 % interval.
struct Interval {
  double low = 0, high = 0;
};

/// What a calibration says, with what is known of its error.
struct CalibratedOdometry {
  OdometryParameters nominal, calibrated;
  std::string method;
  std::map<std::string, Interval> intervals;  ///< by name: left_radius_m, right_radius_m, wheelbase_m
  std::optional<PathNoise> noise;             ///< of the wheels' paths
  std::string noise_from;                     ///< how it was found
};

/// A result folder, as far as it can be exported.
struct Result {
  std::string folder;
  std::string name;
  std::optional<Recording> recording;             ///< of `umbsim run` and of recordings
  std::optional<CalibratedOdometry> calibration;  ///< of `umbsim run` and `umbsim calibrate`
  std::string twin_file;                          ///< of a diagnosis; empty if there is none
  std::string version, input;                     ///< of provenance.json
};

/// Throws InputError: no result of this program, or one that is damaged.
Result read_result(const std::string& folder);

}  // namespace umbsim::exchange
