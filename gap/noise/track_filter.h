#pragma once

#include <Eigen/Core>
#include <vector>

#include "recording/recording.h"

namespace umbsim::gap {

/// What makes two runs of the same robot differ, and what the tracker adds.
struct NoiseModel {
  double heading_rad2_pm = 3.6e-7;  ///< variance of heading per metre that a wheel rolls, rad^2/m
  double along_m2_pm = 1e-8;        ///< of the distance, m^2/m
  double across_m2_pm = 1e-9;       ///< sideways, m^2/m
  double position_sd_m = 3e-4;      ///< of one absolute position, with the encoder's rounding
  double heading_sd_rad = 3e-4;
  double clock_s = 1e-4;  ///< scatter of the moments at which poses were taken

  /// A total station sees no headings, whatever stands in their column.
  bool sees_headings() const { return heading_sd_rad < 1; }
};

/// Roughness k of the floor (noise.wheel_noise_m_per_sqrt_m of a scenario) that makes the heading walk by this much:
/// with both wheels' paths varying by k^2 per metre, its variance is 2 k^2 / b^2.
double roughness_m_per_sqrt_m(double heading_walk_rad_per_sqrt_m, double wheelbase_m);

/// Errors of a track against a prediction, (along, across, heading) in the predicted robot's frame: 3 rows a sample.
using TrackColumns = Eigen::MatrixXd;

/// How a small error of the pose (along, across, heading) moves along when the robot moves by `u`: u^-1 e u to first
/// order.
Eigen::Matrix3d error_transition(const Pose2& u);

/// Log of the pose error: rows 3k..3k+2 are X_predicted^-1 X_true of sample k.
Eigen::VectorXd track_error(const std::vector<Pose2>& predicted, const std::vector<Pose2>& actual);

/// What each motion of `actual` does beyond that of `predicted`, in the predicted robot's frame: per sample, of the
/// motion before it.
std::vector<Eigen::Vector3d> motion_errors(const std::vector<Pose2>& predicted, const std::vector<Pose2>& actual);

/// A Kalman filter along one run. Errors of the pose grow by the noise model and are seen through the tracker's noise;
/// the innovations, each over its own standard deviation, are white if the model is right. The filter is linear: any
/// column of track errors (a residual, or what an effect would do) is whitened alike.
class TrackFilter {
 public:
  /// `path`: predicted poses; `rolled_m`: mean distance that the wheels rolled before each sample (same length, first
  /// 0). `observed`: which samples the tracker really saw; empty: all. `velocity`: of the robot at each sample (along,
  /// across, turning; m/s, rad/s), for the scatter of the clock; empty: none. `more`: further variance of the error
  /// that each motion makes (along, across, heading); empty: none.
  TrackFilter(const std::vector<Pose2>& path, const std::vector<double>& rolled_m, const NoiseModel& noise,
              const std::vector<bool>& observed = {}, const std::vector<Eigen::Vector3d>& velocity = {},
              const std::vector<Eigen::Vector3d>& more = {});

  /// Errors of `actual` against `predicted` as this filter carries them along: what was wrong with each motion from
  /// sample to sample, propagated to first order. So they are linear in what acts on the motions, however far the
  /// tracks part; the pose error itself has the square of a heading error times the way. They are linear in what single
  /// headings are read wrong by, too. Of a tracker that sees no headings the same as track_error().
  Eigen::VectorXd error(const std::vector<Pose2>& predicted, const std::vector<Pose2>& actual) const;

  TrackColumns whiten(const TrackColumns& columns) const;
  /// Sum over samples of log det of the innovations' covariance.
  double log_det() const { return log_det_; }
  std::size_t samples() const { return steps_.size(); }

  /// For a unit impulse (along, across, heading) taken just before each sample: its whitened track times `white` (a
  /// column from whiten), and times itself. One pass backwards for all samples.
  struct ImpulseProducts {
    std::vector<Eigen::Vector3d> with_column;
    std::vector<Eigen::Matrix3d> with_itself;
  };
  ImpulseProducts impulse_products(const Eigen::VectorXd& white) const;

  /// What impulses (along, across, heading; per sample, in the robot's frame, taken before that sample) do to the
  /// track.
  Eigen::VectorXd propagate(const std::vector<Eigen::Vector3d>& impulses) const;

 private:
  struct Step {
    Eigen::Matrix3d transition;  ///< of the error, from the sample before
    Eigen::Matrix3d gain;
    Eigen::Matrix3d whitener;  ///< inverse Cholesky factor of the innovation's covariance
  };
  std::vector<Step> steps_;
  bool sees_headings_ = false;
  double log_det_ = 0;
};

}  // namespace umbsim::gap
