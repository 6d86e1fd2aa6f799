#pragma once

#include <array>
#include <optional>
#include <vector>

#include "odometry/uncertainty.h"
#include "recording/recording.h"
#include "umbmark/figures.h"

namespace umbsim {

/// Both wheels at one moment: how far they turned, what they carry, how long they have slid at their friction limit.
struct WheelMoment {
  std::array<double, 2> angle_rad{};
  std::array<double, 2> load_n{};
  std::array<double, 2> slid_s{};
};

/// What the results need of a run beside its rows: few numbers, however long it is.
struct RunDigest {
  ReturnError error;
  std::vector<Pose2> truth;     ///< every `stride`-th absolute pose and the last one, floor frame
  std::vector<Pose2> odometry;  ///< at the same moments
  std::vector<double> time_s;   ///< the moments
  std::vector<WheelMoment> wheels;       ///< the same; empty where nobody measures them
  std::vector<UncertainPose> estimates;  ///< the same; empty if the scenario has no `uncertainty`
  std::size_t stride = 1;
};

/// Makes a digest of a run's rows as they come, an encoder row before the absolute pose of the same time.
class Digester {
 public:
  /// `truths`: how many absolute poses will come; about `most_poses` of them are kept.
  Digester(const OdometryParameters& odometry, std::size_t truths, std::size_t most_poses);

  void add(const EncoderSample& row);
  void add(const TruthSample& row, const std::optional<UncertainPose>& estimate,
           const std::optional<WheelMoment>& wheels = {});
  RunDigest finish(const std::string& run);

 private:
  OdometryParameters odometry_;
  std::size_t truths_;
  std::size_t seen_ = 0;
  EncoderSample first_;
  Pose2 start_;
  Pose2 end_;
  std::optional<DeadReckoning> from_start_;  // in the frame of the start
  std::optional<DeadReckoning> on_floor_;
  RunDigest digest_;
};

}  // namespace umbsim
