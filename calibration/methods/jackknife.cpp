#include "calibration/methods/jackknife.h"

#include <map>

namespace umbsim::calibration {
namespace {

std::map<std::string, std::vector<std::size_t>> strata(const Runs& runs) {
  std::map<std::string, std::vector<std::size_t>> by_condition;
  for (std::size_t i = 0; i < runs.size(); ++i) by_condition[runs[i].condition].push_back(i);
  return by_condition;
}

}  // namespace

void set_interval(Fit& fit, const Runs& runs, std::vector<std::optional<LogFactors>> left_out) {
  fit.left_out = std::move(left_out);
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double squares = 0;  // Satterthwaite's denominator, of the trace
  for (const auto& [condition, members] : strata(runs)) {
    const double n = double(members.size());
    if (members.size() < 2) {
      fit.warnings.push_back("no interval: " + condition + " was driven once only, how runs differ is not known");
      fit.covariance.reset();
      return;
    }
    LogFactors mean = LogFactors::Zero();
    for (const std::size_t i : members) mean += *fit.left_out[i] / n;
    Eigen::Matrix3d part = Eigen::Matrix3d::Zero();
    for (const std::size_t i : members)
      part += (*fit.left_out[i] - mean) * (*fit.left_out[i] - mean).transpose() * (n - 1) / n;
    covariance += part;
    squares += part.trace() * part.trace() / (n - 1);
  }
  fit.covariance = covariance;
  fit.degrees_of_freedom = squares > 0 ? covariance.trace() * covariance.trace() / squares : 0;
}

Fit with_interval(const FitFunction& fit, const Runs& runs, const OdometryParameters& nominal) {
  Fit result = fit(runs, nominal);
  if (result.covariance) return result;
  std::vector<std::optional<LogFactors>> left_out(runs.size());
  for (const auto& [condition, members] : strata(runs)) {
    if (members.size() < 2) continue;
    for (const std::size_t i : members) {
      Runs others = runs;
      others.erase(others.begin() + std::ptrdiff_t(i));
      left_out[i] = fit(others, nominal).factors;
    }
  }
  set_interval(result, runs, std::move(left_out));
  return result;
}

}  // namespace umbsim::calibration
