#pragma once

#include <string>
#include <vector>

#include "core/random.h"
#include "recording/recording.h"

namespace umbsim::worlds {

constexpr const char* kTrackerKinds[] = {"mocap", "camera", "total_station", "tape"};

/// What measures the absolute pose, and what is wrong with it.
struct TrackerChoice {
  std::string kind = "mocap";
  double rate_hz = 100;
  double position_sd_m = 0.0003;
  double heading_sd_rad = 0.0003;
  double delay_s = 0;       ///< a pose carries the time at which it arrives
  double clock_drift = 0;   ///< of its clock against the encoders': seconds a second
  double dropout = 0;       ///< share of the poses that are lost, in stretches
  double dropout_s = 0.3;   ///< mean length of a stretch
  bool end_points = false;  ///< start and end only
  bool sees_heading = true;  ///< a single prism has none
  Pose2 X_TW;               ///< its frame: the floor frame turned and shifted
  Pose2 X_BM;               ///< the marker on the robot, off the axle's middle
};

/// What this kind is like before anything is wrong with it.
TrackerChoice exact_tracker(const std::string& kind);
TrackerChoice draw_tracker(const std::string& kind, RandomStream& random);

/// What the tracker writes down of a run whose true poses are `dense` (increasing times, first to last moment of the
/// run; linear between them). Without a heading it writes 0.
std::vector<TruthSample> observe(const std::vector<TruthSample>& dense, const TrackerChoice& tracker,
                                 RandomStream random);

/// Linear between the samples, held before and after them.
Pose2 pose_at(const std::vector<TruthSample>& dense, double time_s);

}  // namespace umbsim::worlds
