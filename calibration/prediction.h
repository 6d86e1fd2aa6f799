#pragma once

#include <string>
#include <vector>

#include "core/pose2.h"
#include "odometry/dead_reckoning.h"
#include "recording/recording.h"

namespace umbsim::calibration {

/// Poses of every run at the times of its truth, as somebody predicts them from the ticks.
struct Prediction {
  std::string name;
  std::vector<std::vector<Pose2>> tracks;
};

/// How far a predicted run is from the recorded one.
struct RunError {
  double final_mm = 0;        ///< at the end, start pose and heading of the tracker's frame fitted to the run
  double along_mm = 0;        ///< root mean square along the run, the same
  double raw_final_mm = 0;    ///< at the end, the recorded start taken as exact
  double frame_deg = 0;       ///< fitted turn of the tracker's frame
};

/// The motion of the plane (turn about the origin, then shift) that takes a track's positions nearest to the recorded
/// ones, by least squares.
Pose2 best_motion(const RecordedRun& run, const std::vector<Pose2>& track);

/// Errors of one run. The best motion of the whole predicted track stands for the start pose and the frame's heading,
/// which no prediction can know.
RunError prediction_error(const RecordedRun& run, const std::vector<Pose2>& predicted);

/// Dead reckoning on the recorded ticks, at the times of the truth, from its first pose.
std::vector<Pose2> reckoned_track(const RecordedRun& run, const OdometryParameters& odometry);

/// Of every run.
Prediction reckoned(const std::string& name, const Recording& recording, const OdometryParameters& odometry);

}  // namespace umbsim::calibration
