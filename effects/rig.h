#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "odometry/encoder.h"
#include "sim/model/drivetrain.h"
#include "sim/model/floor.h"
#include "sim/model/push.h"
#include "sim/model/robot_model.h"

namespace umbsim {

/// Which run a rig is built for, for effects that differ from run to run.
struct RunInfo {
  std::string id;
  int number = 0;  ///< counts all runs of an experiment in order, from 0
  std::uint64_t seed = 0;
};

/// What the driver asks of the robot, relative to the course's own speeds and accelerations.
struct CommandedMotion {
  double acceleration_factor = 1;  ///< of linear and angular accelerations
  double turn_speed_factor = 1;    ///< of the turns' angular speed and acceleration
};

/// A push during one leg (time 0 of `push`: the leg's start).
struct LegPush {
  int leg = 1;
  Push push;
};

/// Everything that is simulated, as plain data. Effects change this description and nothing else.
struct Rig {
  RobotModel robot;
  Drivetrain drivetrain;
  EncoderSpec encoders;
  Floor floor;
  CommandedMotion commanded_motion;
  std::vector<LegPush> pushes;
  RunInfo run;
};

}  // namespace umbsim
