#pragma once

#include <string>
#include <vector>

#include "recording/recording.h"

namespace umbsim {

/// A part of a run between two changes of what the robot does, found from the encoders alone.
struct Stretch {
  enum class Kind { still, leg, turn };
  Kind kind = Kind::still;
  int leg = 0;             ///< legs count from 1; a turn belongs to the leg before it; 0 before the first leg
  std::size_t first = 0;   ///< index of the encoder sample at its start
  std::size_t last = 0;    ///< index of the encoder sample at its end (the next stretch's first)
  double start_s = 0;
  double end_s = 0;
  double length_m = 0;     ///< along the path, by nominal odometry
  double angle_rad = 0;    ///< turned, by nominal odometry
};

const char* name(Stretch::Kind kind);

/// The run cut into standstills, legs and turns by the nominal odometry's speeds. Without standstills at the corners
/// (rolling turns, free driving) a stretch changes where the path begins or ends to curve.
std::vector<Stretch> stretches(const RecordedRun& run, const RecordedRobot& robot);

}  // namespace umbsim
