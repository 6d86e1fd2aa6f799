#include "calibration/methods/squares/own_bias.h"

#include <cmath>

#include "calibration/calibrate.h"

namespace umbsim::calibration {
namespace {

constexpr int kMostSteps = 200;
constexpr double kMoveDone = 1e-12;

// A move that the odometry takes for an arc, as a robot of these factors makes it.
Pose2 moved(double way_m, double turn_rad, double wheelbase_m, const LogFactors& truth) {
  const double left_m = (way_m - wheelbase_m / 2 * turn_rad) * std::exp(truth[0]);
  const double right_m = (way_m + wheelbase_m / 2 * turn_rad) * std::exp(truth[1]);
  return arc((left_m + right_m) / 2, (right_m - left_m) / (wheelbase_m * std::exp(truth[2])));
}

Cluster returned(const SquareCourse& course, const OdometryParameters& nominal, const LogFactors& truth, double sense) {
  Pose2 X_SB;
  const double turn_rad = sense * M_PI / 2;
  for (int leg = 0; leg < 4 * course.laps; ++leg) {
    X_SB = X_SB * moved(course.side_m - 2 * course.turn_radius_m, 0, nominal.wheelbase_m, truth);
    X_SB = X_SB * moved(course.turn_radius_m * M_PI / 2, turn_rad, nominal.wheelbase_m, truth);
  }
  return cluster({{"", X_SB.x_m, X_SB.y_m, X_SB.theta_rad - 4 * course.laps * turn_rad, course.laps}});
}

}  // namespace

LogFactors endpoint_answer(const std::vector<SquareCourse>& courses, const OdometryParameters& nominal,
                           const LogFactors& truth) {
  LogFactors sum = LogFactors::Zero();
  double weight = 0;
  for (const SquareCourse& c : courses) {
    const Umbmark u =
        umbmark(returned(c, nominal, truth, -1), returned(c, nominal, truth, 1), c.side_m, nominal.wheelbase_m);
    sum += c.weight * log_factors(corrected(nominal, u.endpoint), nominal);
    weight += c.weight;
  }
  return sum / weight;
}

std::optional<LogFactors> own_bias(const std::vector<SquareCourse>& courses, const OdometryParameters& nominal,
                                   const LogFactors& answer) {
  LogFactors robot = answer;
  for (int step = 0; step < kMostSteps; ++step) {
    const LogFactors missing = answer - endpoint_answer(courses, nominal, robot);
    // The mean radius is not seen, only what passes through the formulas' rounding of it.
    const double scale = (missing[0] + missing[1]) / 2;
    const LogFactors move = missing - LogFactors(scale, scale, 0);
    robot += move;
    if (!robot.allFinite() || robot.norm() > 1) return std::nullopt;
    if (move.norm() < kMoveDone) return answer - robot;
  }
  return std::nullopt;
}

}  // namespace umbsim::calibration
