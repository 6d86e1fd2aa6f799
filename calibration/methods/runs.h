#pragma once

#include <string>
#include <vector>

#include "odometry/dead_reckoning.h"
#include "recording/recording.h"

namespace umbsim::calibration {

/// One run to calibrate on, with the recording that it belongs to.
struct TrainingRun {
  const Recording* recording = nullptr;
  const RecordedRun* run = nullptr;
  std::size_t recording_index = 0;
  std::string condition;  ///< recording, direction and what else the run was driven with: runs alike share it
  double weight = 1;      ///< runs like it that it stands for

  bool tracked() const { return recording->truth_kind == "track" && run->truth.size() > 2; }
  const std::string& shape() const { return recording->path.shape; }
};

using Runs = std::vector<TrainingRun>;

/// The plain runs (no cables) of several recordings of one robot. `recordings` must outlive them.
Runs training_runs(const std::vector<Recording>& recordings, const std::vector<std::string>& names);

/// The robot as the recording describes it.
OdometryParameters nominal_odometry(const RecordedRobot& robot);

}  // namespace umbsim::calibration
