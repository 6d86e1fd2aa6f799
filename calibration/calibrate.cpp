#include "calibration/calibrate.h"

#include <fmt/format.h>

namespace umbsim {

const char* name(CalibrationMethod method) { return method == CalibrationMethod::endpoint ? "endpoint" : "heading"; }

const char* when_to_trust(CalibrationMethod method) {
  return method == CalibrationMethod::endpoint
             ? "as published; needs positions only, so no wrong heading touches it; biased for large errors "
               "(small angles)"
             : "exact for large errors; needs headings as good as the positions, and an exact start heading";
}

OdometryParameters corrected(const OdometryParameters& odometry, const ErrorEstimate& errors) {
  OdometryParameters result = odometry;
  result.left_radius_m *= errors.left_factor;
  result.right_radius_m *= errors.right_factor;
  result.wheelbase_m *= errors.e_b;
  return result;
}

std::string calibration_yaml(const OdometryParameters& o, const std::string& comment) {
  return fmt::format(
      "# {}\n# Put this block into a scenario, or give it to the robot's controller.\n"
      "odometry:\n  left_radius_m: {:.9f}\n  right_radius_m: {:.9f}\n  wheelbase_m: {:.9f}\n{}",
      comment, o.left_radius_m, o.right_radius_m, o.wheelbase_m,
      o.scrub == 0 ? "" : fmt::format("  scrub: {:.9f}\n", o.scrub));
}

}  // namespace umbsim
