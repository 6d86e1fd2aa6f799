#include "calibration/methods/paths/least_squares.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "calibration/methods/paths/pieces.h"

namespace umbsim::calibration {
namespace {

constexpr double kBlind = 1e6;    // condition number beyond which headings do not tell both wheels apart
constexpr double kClosed = 0.05;  // of the way, that pieces must lead from start to end for positions to tell a scale

}  // namespace

Fit fit_least_squares(const Runs& runs, const OdometryParameters& nominal) {
  // Step 1: theta_end - theta_start = (c_R / b) r - (c_L / b) l, with r and l by nominal radii over the wheelbase.
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  const CutRuns cut(runs, nominal, kPartsOfARun);
  for (const Piece& p : cut.pieces(nominal)) {
    const Eigen::Vector2d row(-p.counted.left_m / nominal.wheelbase_m, p.counted.right_m / nominal.wheelbase_m);
    normal += p.run->weight * row * row.transpose();
    right += p.run->weight * row * p.tracked.theta_rad;
  }
  Fit fit;
  fit.condition = condition_number(normal);
  if (fit.condition > kBlind)
    throw NotApplicable("the headings do not tell both wheels apart: drive straight lines as well as turns, both ways");
  const Eigen::Vector2d over_b = normal.ldlt().solve(right);
  if (!(over_b.minCoeff() > 0))
    throw NotApplicable("headings and counts contradict each other: a wheel would roll backwards");
  // Step 2: with these the reckoned positions are proportional to b.
  const OdometryParameters shape = scaled(nominal, {std::log(over_b[0]), std::log(over_b[1]), 0});
  double own = 0, product = 0, way = 0;
  for (const Piece& p : cut.pieces(shape)) {
    const Pose2& s = p.counted.pose;
    own += p.run->weight * (s.x_m * s.x_m + s.y_m * s.y_m);
    product += p.run->weight * (s.x_m * p.tracked.x_m + s.y_m * p.tracked.y_m);
    way += p.run->weight * std::pow((std::abs(p.counted.left_m) + std::abs(p.counted.right_m)) / 2, 2);
  }
  fit.scale_observed = own > kClosed * kClosed * way && product > 0;
  const double log_b = fit.scale_observed ? std::log(product / own) : -(std::log(over_b[0]) + std::log(over_b[1])) / 2;
  fit.factors = {std::log(over_b[0]) + log_b, std::log(over_b[1]) + log_b, log_b};
  return fit;
}

}  // namespace umbsim::calibration
