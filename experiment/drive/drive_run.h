#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <string>

#include "experiment/drive/pose_track.h"
#include "experiment/drive/run_digest.h"
#include "experiment/scenario/scenario.h"
#include "recording/recording.h"

namespace umbsim {

/// Standstill with braked motors before the last absolute pose is taken.
constexpr double kRest_s = 0.5;

/// One run to be driven.
struct RunSpec {
  std::string id;
  Direction direction = Direction::cw;
  bool bumped = false;
  int number = 0;  ///< of all runs of the experiment: selects its random streams
};

/// What went wrong with laid cables.
struct CableCount {
  int not_crossed = 0;   ///< the wheel did not get over them
  int without_grip =
      0;  ///< friction below tan psi: the wheel cannot climb them on its own traction, only be pushed over
};

/// Where the rows of driven runs go: encoder counts, absolute poses, estimates. Some 4 kB a simulated second.
struct Rows {
  enum class To { memory, folder, nowhere };
  To to = To::memory;
  std::filesystem::path folder;  ///< of the recording that they belong to
};

/// What is to be made of a run while it is driven.
struct RunOutput {
  Rows rows;
  std::size_t path_poses = 400;    ///< in the digest, about
  std::function<void()> lap_done;  ///< called after every lap; what it throws ends the run
};

/// How the wheels of a run were loaded: left, right.
struct RunStrain {
  std::array<WheelStrain, 2> wheel{};
  double time_s = 0;
};

/// What a run left behind, and what it cost. Rows are in `run` and `track` if they go to memory.
struct DrivenRun {
  RecordedRun run;
  RunDigest digest;
  PoseTrack track;
  PhysicsCost cost;
  CableCount cables;
  RunStrain strain;
};

/// The robot as it really is in this run: the nominal one with the scenario's effects and the run's noise.
Rig rig_for(const Scenario& scenario, const RobotModel& nominal, const RunSpec& spec);

/// Torque limit of each motor at the wheel: the scenario's, else the URDF's, else what the tyres can pass on.
double torque_limit(const Scenario& scenario, const RobotModel& robot);

/// Drives one run: the spine of the program. Throws RunError if the simulation fails or the robot tips over.
DrivenRun drive_run(const Scenario& scenario, const RobotModel& nominal, const OdometryParameters& odometry,
                    const RunSpec& spec, const RunOutput& output = {});

}  // namespace umbsim
