#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibration/calibrate.h"
#include "experiment/drive/drive_run.h"
#include "experiment/scenario/scenario.h"
#include "umbmark/figures.h"

namespace umbsim {

/// Runs that were driven. Their rows are in `recording` if they were kept in memory.
struct DrivenRuns {
  Recording recording;             ///< plain runs, then bumped ones
  std::vector<RunDigest> digests;  ///< of each of its runs
  std::vector<PoseTrack> tracks;   ///< the same; empty ones if the scenario has no `uncertainty`
  std::vector<RunStrain> strains{};  ///< the same
};

/// The squares driven again with calibrated odometry.
struct CalibrationPass : DrivenRuns {
  OdometryParameters odometry;
  Umbmark umbmark;
};

/// What is injected, seen from the odometry that the scenario starts with.
struct InjectedErrors {
  double e_d = 1;
  double e_b = 1;
};

/// One experiment, measured once; tables, JSON and page are written from this record.
struct ExperimentResult : DrivenRuns {
  Scenario scenario;
  RobotModel nominal;
  OdometryParameters odometry;
  Cluster cw;
  Cluster ccw;
  std::optional<Umbmark> umbmark;      ///< both directions were driven
  std::optional<ExtendedUmbmark> extended;
  InjectedErrors injected;
  std::vector<CalibrationPass> passes;
  CableCount cables;                   ///< of all runs
  std::vector<std::string> warnings;   ///< what was assumed of the robot, effects that change nothing, what went wrong
  PhysicsCost cost;
  double wall_s = 0;

  /// Whose corrections went into the odometry before the squares were driven again; none if they were not.
  std::optional<CalibrationMethod> applied() const;
};

/// Drives, measures, calibrates, drives again. Runs go in parallel on `jobs` threads (0: all cores); the result does
/// not depend on their number, but for wall_s. `show_progress`: on a terminal. Rows that go to a folder are written there as
/// they are driven, those of the last calibration pass into its `calibrated`, and memory does not grow with their number.
/// `lap_done` is called after every lap, from any thread; what it throws ends the experiment. Throws InputError, RunError.
ExperimentResult run_experiment(const Scenario& scenario, int jobs, bool show_progress = true, const Rows& rows = {},
                                const std::function<void()>& lap_done = {});

/// Effects of the scenario that change nothing in any of its runs (effects/silent.h).
std::vector<std::string> silent_effects(const Scenario& scenario, const RobotModel& nominal);

/// E_d and E_b of the simulated robot as built, against the odometry's beliefs.
InjectedErrors injected_errors(const Rig& rig, const OdometryParameters& odometry);

}  // namespace umbsim
