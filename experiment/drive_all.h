#pragma once

#include <functional>
#include <vector>

#include "experiment/run.h"

namespace umbsim {

/// How the runs of an experiment are driven, whatever they are.
struct Driving {
  Rows rows;
  bool show_progress;
  std::function<void()> lap_done;
};

/// The scenario's runs, direction by direction; `bumped`: with cables. Their numbers, which choose random streams,
/// begin with `first_number`.
std::vector<RunSpec> plan_runs(const Scenario& s, bool bumped, int first_number);

/// A recording of the scenario without runs.
Recording empty_recording(const Scenario& s, const RobotModel& nominal);

/// Drives runs in parallel and adds them to `into`, their costs to `result`.
void drive_all(ExperimentResult& result, const OdometryParameters& odometry, const std::vector<RunSpec>& specs,
               DrivenRuns& into, const Driving& driving);

}  // namespace umbsim
