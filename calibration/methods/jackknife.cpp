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

Runs without_run(const Runs& runs, std::size_t left_out) {
  double alike = 0;
  for (const TrainingRun& r : runs) alike += r.condition == runs[left_out].condition;
  Runs others;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (i == left_out) continue;
    others.push_back(runs[i]);
    if (runs[i].condition == runs[left_out].condition) others.back().weight *= alike / (alike - 1);
  }
  return others;
}

void set_interval(Fit& fit, const Runs& runs, std::vector<std::optional<LogFactors>> left_out) {
  fit.left_out = std::move(left_out);
  fit.covariance.clear();
  for (const auto& [condition, members] : strata(runs)) {
    const double n = double(members.size());
    if (members.size() < 2) {
      fit.warnings.push_back("no interval: " + condition + " was driven once only, how runs differ is not known");
      fit.covariance.clear();
      return;
    }
    LogFactors mean = LogFactors::Zero();
    for (const std::size_t i : members) mean += *fit.left_out[i] / n;
    CovariancePart part{Eigen::Matrix3d::Zero(), n - 1};
    for (const std::size_t i : members)
      part.covariance += (*fit.left_out[i] - mean) * (*fit.left_out[i] - mean).transpose() * (n - 1) / n;
    fit.covariance.push_back(part);
  }
}

Fit with_interval(const FitFunction& fit, const Runs& runs, const OdometryParameters& nominal) {
  Fit result = fit(runs, nominal);
  if (!result.covariance.empty()) return result;
  std::vector<std::optional<LogFactors>> left_out(runs.size());
  for (const auto& [condition, members] : strata(runs)) {
    if (members.size() < 2) continue;
    for (const std::size_t i : members) left_out[i] = fit(without_run(runs, i), nominal).factors;
  }
  set_interval(result, runs, std::move(left_out));
  return result;
}

}  // namespace umbsim::calibration
