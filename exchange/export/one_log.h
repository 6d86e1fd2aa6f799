#pragma once

#include <string>
#include <vector>

#include "odometry/dead_reckoning.h"
#include "recording/recording.h"

namespace umbsim::exchange {

/// A run's place in one log that holds all of them.
struct Placed {
  const RecordedRun* run;
  double begin_s;       ///< of the run's time 0
  double from_s, to_s;  ///< of its first and last row
};

/// The runs one after the other, with five seconds between them.
std::vector<Placed> one_log(const Recording& recording);

/// runs.csv, by which `umbsim import --runs` cuts the log again: seconds since the wheels' first row.
std::string runs_csv(const std::vector<Placed>& log);

/// What a run's odometry believed at each row of the encoders, from the truth's first pose on.
std::vector<Pose2> reckoned(const RecordedRun& run, const OdometryParameters& odometry);

/// What the recording's header believes.
OdometryParameters believed(const RecordedRobot& robot);

}  // namespace umbsim::exchange
