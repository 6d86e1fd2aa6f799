#include "calibration/methods/paths/scale.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "calibration/methods/paths/pieces.h"

namespace umbsim::calibration {
namespace {

constexpr double kBlindRest = 0.05;  // standard deviation of the ratio or the wheelbase beyond which nothing is known

// Columns: log of the radii's ratio, of the wheelbase over the mean radius, of the mean radius, then the others.
Eigen::MatrixXd basis(Eigen::Index n) {
  Eigen::MatrixXd T = Eigen::MatrixXd::Identity(n, n);
  T.topLeftCorner<3, 3>() << -0.5, 0, 1, 0.5, 0, 1, 0, 1, 1;
  return T;
}

// With column 2, the scale, left out.
Eigen::MatrixXd without_scale(const Eigen::MatrixXd& T) {
  Eigen::MatrixXd fewer(T.rows(), T.cols() - 1);
  fewer << T.leftCols(2), T.rightCols(T.cols() - 3);
  return fewer;
}

ScaleCheck solve(const Eigen::MatrixXd& normal, const Eigen::VectorXd& right, const Eigen::MatrixXd& T) {
  ScaleCheck result;
  const Eigen::MatrixXd N = T.transpose() * normal * T;
  const Eigen::VectorXd d = N.diagonal().cwiseSqrt().cwiseMax(1e-300).cwiseInverse();
  const Eigen::MatrixXd scaled = d.asDiagonal() * N * d.asDiagonal();
  result.condition = condition_number(N);
  const Eigen::LDLT<Eigen::MatrixXd> solver(scaled);
  const Eigen::MatrixXd inverse =
      d.asDiagonal() * solver.solve(Eigen::MatrixXd::Identity(N.rows(), N.cols())) * d.asDiagonal();
  result.step = T * (inverse * (T.transpose() * right));
  result.covariance = T * inverse * T.transpose();
  return result;
}

double variance(const ScaleCheck& s, const Eigen::Vector3d& direction) {
  return direction.dot(s.covariance.topLeftCorner<3, 3>() * direction);
}

bool known(double variance, double sd) { return std::isfinite(variance) && variance >= 0 && variance < sd * sd; }

}  // namespace

ScaleCheck solve_with_scale(const Eigen::MatrixXd& normal, const Eigen::VectorXd& right, bool ask) {
  const Eigen::MatrixXd T = basis(normal.rows());
  if (ask) {
    ScaleCheck all = solve(normal, right, T);
    if (std::isfinite(all.condition) && known(variance(all, {0.5, 0.5, 0}), kBlindScale)) return all;
  }
  ScaleCheck rest = solve(normal, right, without_scale(T));
  rest.observed = false;
  rest.solved = known(variance(rest, {-1, 1, 0}), kBlindRest) && known(variance(rest, {-0.5, -0.5, 1}), kBlindRest);
  if (!rest.solved)
    rest.why = "the paths do not tell the wheels' ratio from the wheelbase: drive both ways, straight and turning";
  return rest;
}

}  // namespace umbsim::calibration
