#pragma once

#include "bench/worlds/world/world.h"

namespace umbsim::worlds {

/// How a world is driven once.
struct Drive {
  Faults faults;
  Noise noise;
  std::uint64_t seed = 1;
  double finer_encoders = 1;  ///< for drives without noise: quantisation is noise
};

/// Counts, commands and true poses of every run, at the control rate and from slice to slice.
struct DrivenWorld {
  std::vector<RecordedRun> runs;  ///< truth: the true poses, dense
  std::vector<bool> arrived;      ///< the driver was done before the recorder stopped
  std::int64_t steps = 0;
};

/// Drives all runs. The recorder of a run stops when its course should be over, whatever the robot does. Throws
/// RunError where the robot falls over or the engine fails, InputError where the engine cannot build it.
DrivenWorld drive_world(const World& world, const Drive& drive);

/// Whether every run was driven to its end by a robot that stands on its wheels and rolls.
bool drives(const World& world, const DrivenWorld& driven);

/// As an experimenter with this world's tracker would write it down; counts in the unit that he believes in.
Recording record(const World& world, const DrivenWorld& driven, std::uint64_t seed);

/// True poses at the moments of the counts and without any error, for severities.
Recording record_exactly(const World& world, const DrivenWorld& driven, double finer_encoders);

}  // namespace umbsim::worlds
