#include "calibration/methods/likelihood/scrub.h"

#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <map>

#include "calibration/methods/jackknife.h"

namespace umbsim::calibration {
namespace {

constexpr double kLeastAbove = 1e-200;
constexpr double kLeastTold = 1e-3;  // of the belief's variance, by which the data narrow it: less is nothing

// A Gaussian cut at zero.
struct Cut {
  double centre = 0;
  double sd = 0;

  double quantile(double share) const {
    // Through what lies above, which keeps its digits however far below zero the centre is.
    const boost::math::normal n;
    const double above = boost::math::cdf(boost::math::complement(n, -centre / sd));
    if (above < kLeastAbove) return sd * sd / -centre * -std::log1p(-share);  // there the tail falls off exponentially
    return centre + sd * boost::math::quantile(boost::math::complement(n, (1 - share) * above));
  }
  double hazard() const {
    const boost::math::normal n;
    // Far below zero by its asymptotic series (Abramowitz & Stegun 26.2.12).
    const double u = -centre / sd;
    if (boost::math::cdf(n, -u) < kLeastAbove) return u + 1 / u - 2 / (u * u * u);
    return boost::math::pdf(n, centre / sd) / boost::math::cdf(n, centre / sd);
  }
  double mean() const { return centre + sd * hazard(); }
  double variance() const { return sd * sd * (1 - hazard() * (hazard() + centre / sd)); }
};

// Of the answers without each run, condition by condition; 0 where a condition was driven once.
double jackknife_variance(const std::vector<double>& left_out, const Runs& runs) {
  std::map<std::string, std::vector<double>> by_condition;
  for (std::size_t r = 0; r < runs.size(); ++r) by_condition[runs[r].condition].push_back(left_out[r]);
  double variance = 0;
  for (const auto& [condition, values] : by_condition) {
    const double n = double(values.size());
    double mean = 0;
    for (const double v : values) mean += v / n;
    for (const double v : values) variance += (n - 1) / n * (v - mean) * (v - mean);
  }
  return variance;
}

// From the fit's value, with the belief in it, to the posterior with a data variance that repeats bear out.
Cut posterior(const ScrubFit& said, const Runs& runs) {
  const double belief = kUsualScrub * kUsualScrub;
  const double told = 1 - said.variance / belief;
  if (told < kLeastTold) return {0, kUsualScrub};
  const double by_data = said.value / told;
  const double by_model = said.variance / told, by_repeats = jackknife_variance(said.left_out, runs) / (told * told);
  const double variance = 1 / (1 / std::max(by_model, by_repeats) + 1 / belief);
  return {variance * by_data / std::max(by_model, by_repeats), std::sqrt(variance)};
}

}  // namespace

void believe(const ScrubFit& said, const Runs& runs, Fit& fit) {
  const Cut p = posterior(said, runs);
  const double mean = p.mean();
  fit.scrub = Estimate{mean, p.quantile(0.025), p.quantile(0.975)};
  std::vector<std::optional<LogFactors>> left_out = fit.left_out;
  fit.left_out_scrub.assign(runs.size(), mean);
  for (std::size_t r = 0; r < left_out.size(); ++r) {
    if (left_out[r]) *left_out[r] += (mean - said.left_out[r]) * said.factor_slope;
  }
  fit.factors += (mean - said.value) * said.factor_slope;
  bool repeated = !left_out.empty();
  for (const auto& l : left_out) repeated = repeated && l;
  if (repeated) {
    set_interval(fit, runs, std::move(left_out));
  } else {
    // The noise model's, with what it says of scrub taken out.
    fit.left_out = std::move(left_out);
    fit.covariance[0].covariance -= said.variance * said.factor_slope * said.factor_slope.transpose();
  }
  fit.covariance.push_back({p.variance() * said.factor_slope * said.factor_slope.transpose(), kManyDegrees});
}

}  // namespace umbsim::calibration
