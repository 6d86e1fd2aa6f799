#pragma once

#include "experiment/drive/drive_run.h"

namespace umbsim {

/// The experimenter's own payload, at the centre of mass of the empty robot, so that it shifts no load sideways.
Effect payload_on(const RobotModel& nominal, double payload_kg);

/// Drives the runs that a recording's header plans and fills in what the robot leaves behind. Each run has a course of
/// its own: the recording's path with the run's speed, turn, start heading and payload. Run numbers, which choose
/// random streams and wear, count through all runs. `scenario` gives noise, truth, physics, effects and seed. Every run
/// is recorded for as long as its course should take, a robot that gets round faster waits for the rest. Ticks are
/// written in the unit that the recording's robot believes in: an encoder with coarser steps than that counts in steps
/// of several. Throws RunError if the simulation fails.
Recording drive_planned_runs(const Scenario& scenario, const RobotModel& nominal, Recording planned);

}  // namespace umbsim
