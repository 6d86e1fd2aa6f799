#pragma once

#include <Eigen/Core>
#include <vector>

#include "calibration/methods/fit.h"
#include "calibration/methods/paths/travel.h"

namespace umbsim::calibration {

/// What a whole track is compared with: parameters of the robot, of its recording's tracker and of the run.
constexpr int kRobotSize = 4;    ///< log left radius, log right radius, log wheelbase, scrub
constexpr int kTrackerSize = 4;  ///< heading offset rad, marker x m, marker y m, clock rate
constexpr int kStartSize = 4;    ///< x m, y m, theta rad of the start in the tracker's frame, clock offset s

/// Errors of one run's track and their derivatives.
class TrackError {
 public:
  /// At most some `nodes` moments of the truth, evenly picked. The run must outlive it.
  TrackError(const TrainingRun& run, const OdometryParameters& nominal, std::size_t nodes);

  struct Linearised {
    Eigen::VectorXd error;   ///< tracked minus reckoned marker, frame of the start; 3 rows a node
    Eigen::MatrixXd by;      ///< by robot, tracker, start
    std::vector<Travel> at;  ///< by the parameters asked for
  };
  Linearised at(const double* robot, const double* tracker, const double* start) const;

  const std::vector<TruthSample>& nodes() const { return nodes_; }
  bool tracked() const { return run_.tracked(); }
  const TrainingRun& run() const { return run_; }

 private:
  TrainingRun run_;
  OdometryParameters nominal_;
  std::vector<TruthSample> nodes_;
};

}  // namespace umbsim::calibration
