#include "calibration/methods/squares/squares.h"

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "calibration/calibrate.h"
#include "calibration/methods/squares/own_bias.h"

namespace umbsim::calibration {
namespace {

constexpr int kMostPasses = 200;          // a pass of errors of 5 % removes half of them only
constexpr double kDone = 1e-10;           // of the factors, from pass to pass
constexpr double kSmallBias = 1e-5;       // of the factors: not worth a word

struct Squares {
  Umbmark figures;
  double side_m = 0;
  double runs = 0;  ///< weights of both directions
  std::optional<double> turn_radius_m;  ///< 0: turns in place; none: not known
};

// Return errors of one direction, and their mean by the runs' weights.
class WeightedCluster {
 public:
  void add(const TrainingRun& r, const OdometryParameters& odometry) {
    const ReturnError e = return_error(*r.run, odometry);
    errors_.push_back(e);
    weight_ += r.weight;
    x_m_ += r.weight * e.x_m;
    y_m_ += r.weight * e.y_m;
    theta_rad_ += r.weight * e.theta_rad;
  }
  bool empty() const { return errors_.empty(); }
  Cluster get() const {
    Cluster c = cluster(errors_);
    c.centroid_x_m = x_m_ / weight_;
    c.centroid_y_m = y_m_ / weight_;
    c.heading_rad = theta_rad_ / weight_;
    c.r_cg_m = std::hypot(c.centroid_x_m, c.centroid_y_m);
    return c;
  }

 private:
  std::vector<ReturnError> errors_;
  double weight_ = 0, x_m_ = 0, y_m_ = 0, theta_rad_ = 0;
};

// Of the turns, if all of the recording's squares have the same.
std::optional<double> turn_radius(const Recording& recording) {
  std::optional<double> radius_m;
  for (const RecordedRun& run : recording.runs) {
    const bool arc = run.turn.value_or(recording.path.turn) == "arc";
    const auto given = run.turn_radius_m ? run.turn_radius_m : recording.path.turn_radius_m;
    const auto now = arc ? given : std::optional(0.0);
    if (!now || (radius_m && *radius_m != *now)) return std::nullopt;
    radius_m = now;
  }
  return radius_m;
}

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
    Squares s{*figures, 0, 0, {}};
    for (const TrainingRun& r : runs) {
      if (r.recording_index != i) continue;
      s.side_m = r.recording->path.side_m;
      s.runs += r.weight;
      s.turn_radius_m = turn_radius(*r.recording);
    }
    all.push_back(std::move(s));
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
    const double w = s.runs * (form == CalibrationMethod::endpoint ? s.side_m * s.side_m : 1);
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
    const Cluster &cw = s.figures.cw, &ccw = s.figures.ccw;
    const double se_rad = std::hypot(cw.standard_error_m / cw.laps, ccw.standard_error_m / ccw.laps) / (4 * s.side_m);
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
  WeightedCluster cw, ccw;
  double side_m = 0;
  for (const TrainingRun& r : runs) {
    if (r.recording_index != recording_index || r.shape() != "square") continue;
    side_m = r.recording->path.side_m;
    if (r.run->direction == "cw") cw.add(r, odometry);
    if (r.run->direction == "ccw") ccw.add(r, odometry);
  }
  if (cw.empty() || ccw.empty()) return std::nullopt;
  return umbmark(cw.get(), ccw.get(), side_m, odometry.wheelbase_m);
}

Fit fit_endpoint(const Runs& runs, const OdometryParameters& nominal) {
  Fit fit;
  fit.factors = correction(runs, nominal, CalibrationMethod::endpoint);
  fit.condition = 1;
  std::vector<SquareCourse> courses;
  for (const Squares& s : squares(runs, nominal)) {
    if (!s.turn_radius_m) return with_warnings(std::move(fit), runs, nominal);
    const int laps = int(std::lround((s.figures.cw.laps + s.figures.ccw.laps) / 2));
    courses.push_back({s.side_m, *s.turn_radius_m, s.runs * s.side_m * s.side_m, laps});
  }
  fit.own_bias = own_bias(courses, nominal, fit.factors);
  fit = with_warnings(std::move(fit), runs, nominal);
  if (!fit.own_bias)
    fit.warnings.push_back("no robot gives this answer on squares without noise: its small angles are far too large");
  if (!fit.own_bias || fit.own_bias->norm() < kSmallBias) return fit;
  const double e_d = (*fit.own_bias)[1] - (*fit.own_bias)[0], e_b = (*fit.own_bias)[2];
  fit.warnings.push_back(fmt::format(
      "its formulas take angles for small: by exact kinematics a robot of this answer has E_d off by {:+.5f} and E_b by "
      "{:+.5f}. The intervals reach that much further; the iterated form has no such bias",
      e_d, e_b));
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
