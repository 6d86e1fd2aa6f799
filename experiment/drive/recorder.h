#pragma once

#include <functional>
#include <optional>

#include "core/random.h"
#include "experiment/drive/drive_run.h"
#include "recording/run_writer.h"
#include "umbmark/course.h"

namespace umbsim {

/// Writes down what an experimenter can: ticks, commands, and the absolute pose with its measurement error. Whether the
/// rows are kept or not, the digest is made. Ticks are those of the scenario: encoders that are coarser than the
/// experimenter believes count several at once.
class Recorder {
 public:
  /// `periods`: of the run; its last row is that of this period.
  Recorder(const Scenario& scenario, const RunSpec& spec, const OdometryParameters& odometry, int periods,
           const RunOutput& output);

  void encoders(double time_s, std::int64_t left, std::int64_t right, const WheelSpeeds& command);
  /// Whether an absolute pose is taken in this period.
  bool truth_is_due(int period) const;
  void truth(double time_s, const Pose2& X_WB, const std::optional<UncertainPose>& estimate, const WheelMoment& wheels);

  RecordedRun& run() { return run_; }
  /// Everything but track, cost and cables.
  DrivenRun finish();

 private:
  int truths() const;
  std::int64_t believed(std::int64_t ticks) const;

  TruthChoice truth_;
  RandomStream random_;
  int periods_;
  int stride_;
  double unit_;  ///< ticks that the experimenter believes in, for one of the encoder
  bool in_memory_;
  RecordedRun run_;
  std::optional<RunWriter> writer_;
  Digester digester_;
};

}  // namespace umbsim
