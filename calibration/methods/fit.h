#pragma once

#include <Eigen/Core>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "calibration/methods/runs.h"

namespace umbsim::calibration {

/// Natural logarithms of (left radius, right radius, wheelbase) over the nominal ones.
using LogFactors = Eigen::Vector3d;

OdometryParameters scaled(const OdometryParameters& nominal, const LogFactors& factors);
/// With the fit's scrub, if it has one.
OdometryParameters fitted_odometry(const OdometryParameters& nominal, const struct Fit& fit);
LogFactors log_factors(const OdometryParameters& odometry, const OdometryParameters& nominal);

/// A number with its two-sided 95 % interval; not finite where none is known.
struct Estimate {
  double value = 0;
  double low = 0;
  double high = 0;
  bool has_interval() const;
};

/// Random errors of the wheels' ways: standard deviation after a way s is k sqrt(s) (Chong & Kleeman 1997).
struct WheelNoise {
  Estimate left_m_per_sqrt_m;
  Estimate right_m_per_sqrt_m;
};

/// How the tracker of one recording stands to the robot, as far as the method fits it.
struct TrackerFit {
  std::string recording;
  double heading_offset_rad = 0;  ///< tracked minus driven heading
  double marker_x_m = 0;          ///< tracked point, ahead of the axle's middle
  double marker_y_m = 0;          ///< and left of it
  double clock_offset_s = 0;      ///< encoder time = truth time + offset + rate * truth time
  double clock_rate = 0;
};

/// Degrees of freedom of what is known, not estimated: a noise model, a belief.
constexpr double kManyDegrees = 1e6;

/// Covariance of the factors that one kind of runs brings about, with its degrees of freedom.
struct CovariancePart {
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double degrees_of_freedom = 0;
};

/// What a method says of the robot.
struct Fit {
  LogFactors factors = LogFactors::Zero();
  bool scale_observed = false;  ///< false: the mean radius is the nominal one, by assumption
  double condition = 0;         ///< of the scaled normal equations in what is fitted; 1 is best
  std::optional<WheelNoise> noise;
  std::vector<TrackerFit> trackers;
  std::vector<std::string> warnings;  ///< assumptions that these data break, and what could not be fitted
  /// By which the answer misses even without noise, computed from the answer: intervals reach that much further.
  std::optional<LogFactors> own_bias;
  /// Of the factors, a sum over kinds of runs; empty: not known. Filled by the method or by `with_interval`.
  std::vector<CovariancePart> covariance;
  std::vector<std::optional<LogFactors>> left_out;  ///< the answer without each run, where it was found
  std::optional<Estimate> scrub;                    ///< of `OdometryParameters`, where the method fits it
  std::vector<double> left_out_scrub;               ///< the same without each run; empty: none
};

/// A method's assumptions do not hold for the data, in words: it has no answer.
class NotApplicable : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Figures of a fit. E_d, E_b and the wheelbase that closes squares do not depend on the scale; radii and the mean
/// radius have intervals only where the scale is observed.
struct FitFigures {
  Estimate e_d;  ///< right over left radius
  Estimate e_b;  ///< wheelbase over nominal, both over the mean radius: what turns see
  Estimate mean_radius_m;
  Estimate left_radius_m;
  Estimate right_radius_m;
  Estimate wheelbase_m;
};

/// Variance of gradient . factors with the degrees of freedom behind it (Satterthwaite 1946): each figure has its own,
/// for what differs between cw and ccw runs weighs otherwise in each.
struct Spread {
  double variance = 0;
  double degrees_of_freedom = 0;
};
Spread spread(const std::vector<CovariancePart>& parts, const Eigen::Vector3d& gradient);

/// Gradients of log E_d, log E_b and the log mean radius by the factors.
inline const Eigen::Vector3d kEd{-1, 1, 0}, kEb{-0.5, -0.5, 1}, kMeanRadius{0.5, 0.5, 0};

FitFigures figures(const Fit& fit, const OdometryParameters& nominal);

/// Two-sided 95 % quantile of Student's t; of the normal distribution beyond 200 degrees of freedom.
double t_95(double degrees_of_freedom);

}  // namespace umbsim::calibration
