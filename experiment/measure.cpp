#include "experiment/measure.h"

#include <algorithm>

namespace umbsim {
namespace {

// Differences of E_max below this are the solver's and the quantisation's: no reason for another pass.
constexpr double kWorthCalibrating_m = 1e-4;

Cluster cluster_of(const DrivenRuns& driven, const char* direction, bool bumped) {
  std::vector<ReturnError> errors;
  for (std::size_t i = 0; i < driven.digests.size(); ++i) {
    const RecordedRun& run = driven.recording.runs[i];
    if (run.direction == direction && is_bumped(run) == bumped) errors.push_back(driven.digests[i].error);
  }
  return cluster(std::move(errors));
}

}  // namespace

Umbmark umbmark_of(const DrivenRuns& driven, const OdometryParameters& odometry) {
  return umbmark(cluster_of(driven, "cw", false), cluster_of(driven, "ccw", false), driven.recording.path.side_m,
                 odometry.wheelbase_m);
}

void measure(ExperimentResult& result) {
  result.cw = cluster_of(result, "cw", false);
  result.ccw = cluster_of(result, "ccw", false);
  if (result.scenario.runs.directions.size() < 2 || result.scenario.course.shape != "square") return;
  result.umbmark = umbmark_of(result, result.odometry);
  Cluster cw = cluster_of(result, "cw", true), ccw = cluster_of(result, "ccw", true);
  if (cw.errors.empty() || ccw.errors.empty()) return;
  result.extended = extended_umbmark(std::move(cw), std::move(ccw), *result.umbmark, bump_count(result.recording));
}

bool another_pass(const Umbmark& u) {
  const double standard_error_m = std::max(u.cw.standard_error_m, u.ccw.standard_error_m);
  return u.e_max_syst_m > 3 * standard_error_m && u.e_max_syst_m > kWorthCalibrating_m;
}

InjectedErrors injected_errors(const Rig& rig, const OdometryParameters& o) {
  const double actual = rig.robot.wheels[1].radius_m / rig.robot.wheels[0].radius_m;
  return {actual / (o.right_radius_m / o.left_radius_m), rig.robot.wheelbase_m() / o.wheelbase_m};
}

std::optional<CalibrationMethod> ExperimentResult::applied() const {
  if (scenario.calibration.method == Calibrate::none || !umbmark) return {};
  return scenario.calibration.method == Calibrate::endpoint ? CalibrationMethod::endpoint : CalibrationMethod::heading;
}

}  // namespace umbsim
