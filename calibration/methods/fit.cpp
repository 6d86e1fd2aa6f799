#include "calibration/methods/fit.h"

#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>

namespace umbsim::calibration {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// exp(gradient . factors) * unit.
Estimate figure(const Fit& fit, double unit, const Eigen::Vector3d& gradient, bool known) {
  const double log_value = gradient.dot(fit.factors);
  Estimate e{unit * std::exp(log_value), kNone, kNone};
  if (!fit.covariance || !known) return e;
  const double half = t_95(fit.degrees_of_freedom) * std::sqrt(std::max(0.0, gradient.dot(*fit.covariance * gradient)));
  e.low = unit * std::exp(log_value - half);
  e.high = unit * std::exp(log_value + half);
  return e;
}

}  // namespace

OdometryParameters scaled(const OdometryParameters& nominal, const LogFactors& factors) {
  return {nominal.left_radius_m * std::exp(factors[0]), nominal.right_radius_m * std::exp(factors[1]),
          nominal.wheelbase_m * std::exp(factors[2]), nominal.ticks_per_revolution};
}

LogFactors log_factors(const OdometryParameters& o, const OdometryParameters& nominal) {
  return {std::log(o.left_radius_m / nominal.left_radius_m), std::log(o.right_radius_m / nominal.right_radius_m),
          std::log(o.wheelbase_m / nominal.wheelbase_m)};
}

bool Estimate::has_interval() const { return std::isfinite(low) && std::isfinite(high); }

double t_95(double degrees_of_freedom) {
  if (!(degrees_of_freedom > 0)) return std::numeric_limits<double>::infinity();
  if (degrees_of_freedom > 200) return 1.959964;
  return boost::math::quantile(boost::math::students_t(degrees_of_freedom), 0.975);
}

FitFigures figures(const Fit& fit, const OdometryParameters& nominal) {
  FitFigures f;
  const bool scale = fit.scale_observed;
  f.e_d = figure(fit, nominal.right_radius_m / nominal.left_radius_m, {-1, 1, 0}, true);
  f.e_b = figure(fit, 1, {-0.5, -0.5, 1}, true);
  f.mean_radius_m = figure(fit, std::sqrt(nominal.left_radius_m * nominal.right_radius_m), {0.5, 0.5, 0}, scale);
  f.left_radius_m = figure(fit, nominal.left_radius_m, {1, 0, 0}, scale);
  f.right_radius_m = figure(fit, nominal.right_radius_m, {0, 1, 0}, scale);
  f.wheelbase_m = figure(fit, nominal.wheelbase_m, {0, 0, 1}, scale);
  return f;
}

}  // namespace umbsim::calibration
