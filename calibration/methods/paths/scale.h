#pragma once

#include <Eigen/Core>
#include <string>

namespace umbsim::calibration {

/// A step of least squares in (log left radius, log right radius, log wheelbase, others ...), and whether the data tell
/// the mean radius at all.
struct ScaleCheck {
  Eigen::VectorXd step;
  bool observed = true;
  bool solved = true;
  std::string why;             ///< if not solved
  double condition = 0;        ///< of the scaled normal equations that were solved
  Eigen::MatrixXd covariance;  ///< inverse of the normal equations that were solved, all unknowns
};

/// Beyond this standard deviation of its logarithm the mean radius counts as not observed.
constexpr double kBlindScale = 0.005;

/// Solves `normal` x = `right` (whitened, so that the inverse is a covariance). Where the mean radius would be known to
/// no better than `kBlindScale`, or `ask` is false, it stays and the wheelbase takes its part.
ScaleCheck solve_with_scale(const Eigen::MatrixXd& normal, const Eigen::VectorXd& right, bool ask);

}  // namespace umbsim::calibration
