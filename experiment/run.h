#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibration/calibrate.h"
#include "experiment/drive_run.h"
#include "experiment/scenario.h"
#include "umbmark/figures.h"

namespace umbsim {

/// The squares driven again with calibrated odometry.
struct CalibrationPass {
  OdometryParameters odometry;
  Recording recording;
  std::vector<PoseTrack> tracks;  ///< of each of its runs
  Umbmark umbmark;
};

/// What is injected, seen from the odometry that the scenario starts with.
struct InjectedErrors {
  double e_d = 1;
  double e_b = 1;
};

/// One experiment, measured once; tables, JSON and page are written from this record.
struct ExperimentResult {
  Scenario scenario;
  RobotModel nominal;
  OdometryParameters odometry;
  Recording recording;                 ///< plain runs, then bumped ones
  std::vector<PoseTrack> tracks;       ///< of each of its runs; empty ones if the scenario has no `uncertainty`
  Cluster cw;
  Cluster ccw;
  std::optional<Umbmark> umbmark;      ///< both directions were driven
  std::optional<ExtendedUmbmark> extended;
  InjectedErrors injected;
  std::vector<CalibrationPass> passes;
  CableCount cables;                   ///< of all runs
  PhysicsCost cost;
  double wall_s = 0;
};

/// Drives, measures, calibrates, drives again. Runs go in parallel on `jobs` threads (0: all cores); the result does
/// not depend on their number, but for wall_s. `show_progress`: on a terminal. Throws InputError, RunError.
ExperimentResult run_experiment(const Scenario& scenario, int jobs, bool show_progress = true);

/// E_d and E_b of the simulated robot as built, against the odometry's beliefs.
InjectedErrors injected_errors(const Rig& rig, const OdometryParameters& odometry);

}  // namespace umbsim
