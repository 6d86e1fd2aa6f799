#pragma once

#include <optional>
#include <vector>

#include "core/random.h"
#include "experiment/scenario/scenario.h"
#include "odometry/uncertainty.h"

namespace umbsim {

struct RunSpec;
struct Rows;

/// What the odometry believed of itself at one moment, and what was true. Both in the frame of the run's start.
struct TrackSample {
  UncertainPose estimate;
  Pose2 X_SB;
};

/// The estimates of one run at the moments of its absolute poses; empty if the scenario has no `uncertainty`.
struct PoseTrack {
  std::vector<TrackSample> samples;  ///< if rows are kept in memory
  std::vector<std::size_t> fixes;    ///< the first sample after each absolute fix
  std::optional<TrackSample> end;    ///< the last sample
  std::size_t moved = 0;             ///< samples since it began to move,
  std::size_t moved_inside = 0;      ///< and those whose true position lies in its 95 % ellipse
};

/// Keeps the track of a run, and takes the scenario's absolute fixes: at the end of a leg, before the turn, the true
/// pose is measured with the fix's errors.
class TrackKeeper {
 public:
  TrackKeeper(const Scenario& scenario, const RunSpec& spec, const Plan& plan, const Rows& rows);

  void fix_if_due(int segment, const Pose2& X_WB, UncertainReckoning& reckoning);
  /// The estimate, if the scenario has `uncertainty`.
  std::optional<UncertainPose> note(const Pose2& X_WB, const UncertainReckoning& reckoning);

  PoseTrack track;

 private:
  struct Fix {
    int segment = 0;  // the turn after the leg
    FixNoise noise;
  };
  bool on_;
  bool in_memory_;
  std::size_t noted_ = 0;
  Pose2 X_SW_;
  std::vector<Fix> fixes_;
  std::size_t taken_ = 0;
  RandomStream random_;
};

/// How the predicted ellipses of some runs compare with the truth.
struct UncertaintyFigures {
  int runs = 0;
  PoseCovariance end_covariance = PoseCovariance::Zero();  ///< mean over the runs
  double end_inside_95_share = 0;  ///< of the runs whose true end lies in its 95 % ellipse
  double way_inside_95_share = 0;  ///< the same of all poses on the way
};
UncertaintyFigures uncertainty_figures(const std::vector<const PoseTrack*>& tracks);

}  // namespace umbsim
