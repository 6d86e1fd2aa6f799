#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibration/compare/parts.h"
#include "calibration/methods/methods.h"

namespace umbsim::calibration {

/// Recordings of one robot: to calibrate on, and to be predicted. `names` are those of the tables.
struct Task {
  std::vector<Recording> train, test;
  std::vector<std::string> train_names, test_names;
  OdometryParameters nominal;  ///< as the first recording to train on describes the robot
};

/// Mean errors at the end of a recording's runs.
struct MeanError {
  double final_mm = 0;      ///< start and frame fitted to the track; of end points as `raw_final_mm`
  double raw_final_mm = 0;  ///< the recorded start taken as exact
};

/// What one method comes to. The first of a comparison is "nominal": no calibration at all.
struct MethodResult {
  const Method* method = nullptr;  ///< none: nominal
  std::string name = "nominal";
  std::optional<Fit> fit;
  std::string why_not;          ///< where it has no answer
  OdometryParameters odometry;  ///< nominal where it has none
  std::vector<MeanError> train, test;
  std::optional<double> e_max_m;  ///< of the squares to train on (the largest), by this odometry
  double held_out_mm = 0;       ///< mean of final_mm of runs that were left out; of the nominal where it has no answer
  std::vector<double> fold_mm;  ///< the same of each fold
  int held_out_answers = 0;     ///< folds in which it had one
};

struct Comparison {
  OdometryParameters nominal;
  std::vector<MethodResult> results;  ///< nominal, then the methods asked for
  std::size_t winner = 0;
  std::string why;       ///< the winner, in words
  std::string held_out;  ///< how runs were left out, in words
  int folds = 0;
  Parts parts;
  std::vector<std::string> warnings;  ///< of the whole calibration
};

/// Fits every method of `chosen`, predicts all recordings, leaves out one condition at a time (a run, where there is
/// one condition only) and takes the method that predicts best what it has not seen. Tests have no say in this. Throws
/// InputError if the recordings are of different robots, or the only method asked for has no answer.
Comparison compare(const Task& task, const std::vector<const Method*>& chosen);

/// Of one run.
MeanError run_error(const TrainingRun& run, const OdometryParameters& odometry);

}  // namespace umbsim::calibration
