#pragma once

#include <string>
#include <vector>

#include "calibration/compare/compare.h"
#include "umbmark/figures.h"

namespace umbsim::calibration {

/// One run as it was tracked, and by how much dead reckoning misses it: tracked minus reckoned pose. Start and frame are
/// fitted to the track, as for `MeanError::final_mm`; of end points the recorded start is taken as exact.
struct RunResiduals {
  std::string recording, run, direction;
  bool test = false;              ///< of a recording that is predicted only
  std::vector<double> time_s;     ///< of the truth
  std::vector<Pose2> tracked;     ///< in the floor frame
  std::vector<Pose2> before;      ///< by the nominal odometry
  std::vector<Pose2> after;       ///< by the calibrated one
  std::vector<double> final_mm;   ///< at the end, for each of the comparison's results
};

/// Of every plain run, no more than `most` moments of each, evenly spread with both ends.
std::vector<RunResiduals> run_residuals(const Task& task, const Comparison& comparison, std::size_t most);

/// Return errors of one recording of squares, by the nominal and by the calibrated odometry.
struct SquaresBeforeAfter {
  std::string recording;
  double side_m = 0;
  Umbmark before, after;
};

/// Of every recording of squares to train on that was driven both ways.
std::vector<SquaresBeforeAfter> squares_before_after(const Task& task, const Comparison& comparison);

}  // namespace umbsim::calibration
