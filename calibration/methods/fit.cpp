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
  if (fit.covariance.empty() || !known) return e;
  const Spread s = spread(fit.covariance, gradient);
  const double half = s.variance > 0 ? t_95(s.degrees_of_freedom) * std::sqrt(s.variance) : 0;
  const double bias = fit.own_bias ? gradient.dot(*fit.own_bias) : 0;
  e.low = unit * std::exp(log_value - half - std::max(bias, 0.0));
  e.high = unit * std::exp(log_value + half - std::min(bias, 0.0));
  return e;
}

}  // namespace

OdometryParameters scaled(const OdometryParameters& nominal, const LogFactors& factors) {
  return {nominal.left_radius_m * std::exp(factors[0]), nominal.right_radius_m * std::exp(factors[1]),
          nominal.wheelbase_m * std::exp(factors[2]), nominal.ticks_per_revolution, nominal.scrub};
}

OdometryParameters fitted_odometry(const OdometryParameters& nominal, const Fit& fit) {
  OdometryParameters o = scaled(nominal, fit.factors);
  if (fit.scrub) o.scrub = fit.scrub->value;
  return o;
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

Spread spread(const std::vector<CovariancePart>& parts, const Eigen::Vector3d& gradient) {
  Spread s;
  double squares = 0;
  for (const CovariancePart& p : parts) {
    const double variance = std::max(0.0, gradient.dot(p.covariance * gradient));
    s.variance += variance;
    squares += variance * variance / p.degrees_of_freedom;
  }
  if (squares > 0) s.degrees_of_freedom = s.variance * s.variance / squares;
  return s;
}

FitFigures figures(const Fit& fit, const OdometryParameters& nominal) {
  FitFigures f;
  const bool scale = fit.scale_observed;
  f.e_d = figure(fit, nominal.right_radius_m / nominal.left_radius_m, kEd, true);
  f.e_b = figure(fit, 1, kEb, true);
  f.mean_radius_m = figure(fit, std::sqrt(nominal.left_radius_m * nominal.right_radius_m), kMeanRadius, scale);
  f.left_radius_m = figure(fit, nominal.left_radius_m, {1, 0, 0}, scale);
  f.right_radius_m = figure(fit, nominal.right_radius_m, {0, 1, 0}, scale);
  f.wheelbase_m = figure(fit, nominal.wheelbase_m, {0, 0, 1}, scale);
  return f;
}

}  // namespace umbsim::calibration
