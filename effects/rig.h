#pragma once

#include <cstdint>
#include <string>

#include "odometry/encoder.h"
#include "sim/drivetrain.h"
#include "sim/floor.h"
#include "sim/robot_model.h"

namespace umbsim {

/// Which run a rig is built for, for effects that differ from run to run.
struct RunInfo {
  std::string id;
  int number = 0;  ///< counts all runs of an experiment in order
  std::uint64_t seed = 0;
};

/// Everything that is simulated, as plain data. Effects change this description and nothing else.
struct Rig {
  RobotModel robot;
  Drivetrain drivetrain;
  EncoderSpec encoders;
  Floor floor;
  RunInfo run;
};

}  // namespace umbsim
