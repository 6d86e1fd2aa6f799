#include "calibration/methods/squares.h"

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "calibration/calibrate.h"

namespace umbsim::calibration {
namespace {

constexpr int kMostPasses = 200;          // a pass of errors of 5 % removes half of them only
constexpr double kDone = 1e-10;           // of the factors, from pass to pass
constexpr double kLargeAngle_rad = 0.02;  // of alpha or beta: the formulas' bias is some 1 % of it, or more

struct Squares {
  Umbmark figures;
  double side_m = 0;
};

// Of every recording of squares that has both directions.
std::vector<Squares> squares(const Runs& runs, const OdometryParameters& odometry) {
  std::set<std::size_t> recordings;
  for (const TrainingRun& r : runs) {
    if (r.shape() == "square") recordings.insert(r.recording_index);
  }
  std::vector<Squares> all;
  for (const std::size_t i : recordings) {
    const auto figures = squares_of(runs, i, odometry);
    if (!figures) continue;
    for (const TrainingRun& r : runs) {
      if (r.recording_index != i) continue;
      all.push_back({*figures, r.recording->path.side_m});
      break;
    }
  }
  if (recordings.empty()) throw NotApplicable("needs closed squares; there is none here");
  if (all.empty()) {
    throw NotApplicable("needs squares of both directions: in one, unequal wheels and a wrong wheelbase look alike");
  }
  return all;
}

// Mean of the recordings' corrections, weighted by runs and sides: an angle is known as well as its lever is long.
LogFactors correction(const Runs& runs, const OdometryParameters& odometry, CalibrationMethod form) {
  LogFactors sum = LogFactors::Zero();
  double weight = 0;
  for (const Squares& s : squares(runs, odometry)) {
    const double runs_here = double(s.figures.cw.errors.size() + s.figures.ccw.errors.size());
    const double w = runs_here * (form == CalibrationMethod::endpoint ? s.side_m * s.side_m : 1);
    sum += w * log_factors(corrected(odometry, estimate(s.figures, form)), odometry);
    weight += w;
  }
  return sum / weight;
}

Fit with_warnings(Fit fit, const Runs& runs, const OdometryParameters& nominal) {
  std::size_t used = 0;
  for (const TrainingRun& r : runs) used += r.shape() == "square";
  if (used < runs.size()) fit.warnings.push_back(fmt::format("uses squares only: {} of {} runs", used, runs.size()));
  for (const Squares& s : squares(runs, nominal)) {
    // The same from the y coordinates; both must agree within what small angles leave out.
    const ErrorEstimate& x = s.figures.endpoint;
    const ErrorEstimate& y = s.figures.endpoint_y;
    const double se_rad = std::hypot(s.figures.cw.standard_error_m, s.figures.ccw.standard_error_m) / (4 * s.side_m);
    const double apart = std::max(std::abs(x.alpha_rad - y.alpha_rad), std::abs(x.beta_rad - y.beta_rad));
    const double small = 0.1 * std::max(std::abs(x.alpha_rad), std::abs(x.beta_rad));
    if (apart > 4 * se_rad + small) {
      fit.warnings.push_back(
          fmt::format("x and y of the return positions disagree by {:.2f} deg per turn or leg: more than wheelbase and "
                      "radii is wrong, or the start heading",
                      degrees(apart)));
    }
  }
  return fit;
}

}  // namespace

std::optional<Umbmark> squares_of(const Runs& runs, std::size_t recording_index, const OdometryParameters& odometry) {
  std::vector<ReturnError> cw, ccw;
  double side_m = 0;
  for (const TrainingRun& r : runs) {
    if (r.recording_index != recording_index || r.shape() != "square") continue;
    side_m = r.recording->path.side_m;
    if (r.run->direction == "cw") cw.push_back(return_error(*r.run, odometry));
    if (r.run->direction == "ccw") ccw.push_back(return_error(*r.run, odometry));
  }
  if (cw.empty() || ccw.empty()) return std::nullopt;
  return umbmark(cluster(std::move(cw)), cluster(std::move(ccw)), side_m, odometry.wheelbase_m);
}

Fit fit_endpoint(const Runs& runs, const OdometryParameters& nominal) {
  Fit fit;
  fit.factors = correction(runs, nominal, CalibrationMethod::endpoint);
  fit.condition = 1;
  fit = with_warnings(std::move(fit), runs, nominal);
  for (const Squares& s : squares(runs, nominal)) {
    const double largest = std::max(std::abs(s.figures.endpoint.alpha_rad), std::abs(s.figures.endpoint.beta_rad));
    if (largest < kLargeAngle_rad) continue;
    fit.warnings.push_back(
        fmt::format("angles of {:.1f} deg are not small: the formulas are biased, see the iterated "
                    "form",
                    degrees(largest)));
  }
  return fit;
}

Fit fit_iterated_endpoint(const Runs& runs, const OdometryParameters& nominal) {
  Fit fit;
  for (int pass = 0;; ++pass) {
    LogFactors step = correction(runs, scaled(nominal, fit.factors), CalibrationMethod::endpoint);
    // Corrections of several recordings that differ keep the arithmetic mean each, and shrink the geometric one for
    // ever.
    step.head<2>().array() -= step.head<2>().mean();
    fit.factors += step;
    if (step.norm() < kDone) break;
    if (pass == kMostPasses || !fit.factors.allFinite())
      throw NotApplicable("the passes do not come to rest: the errors are too large for its formulas");
  }
  fit.condition = 1;
  return with_warnings(std::move(fit), runs, nominal);
}

Fit fit_heading(const Runs& runs, const OdometryParameters& nominal) {
  Fit fit;
  fit.factors = correction(runs, nominal, CalibrationMethod::heading);
  fit.condition = 1;
  return with_warnings(std::move(fit), runs, nominal);
}

}  // namespace umbsim::calibration
