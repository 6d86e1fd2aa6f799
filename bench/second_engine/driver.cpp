#include "bench/second_engine/driver.h"

#include <algorithm>
#include <cmath>

namespace umbsim::second_engine {
namespace {

constexpr double kHeadingGain_1ps = 1.5;
constexpr double kAcrossGain_radpms = 1;
constexpr double kGentle = 2.0 / 3;  // turns on the spot brake more gently than they speed up
constexpr double kArrived_m = 0.001;
constexpr double kArrived_rad = 0.0015;

}  // namespace

Driver::Driver(const Course& course, Direction direction, const DriveGeometry& believed, double period_s)
    : course_(course), sign_(direction == Direction::ccw ? 1 : -1), believed_(believed), period_s_(period_s) {}

// Metres of a leg, radians of a turn.
double Driver::left_of_segment(const Pose2& X_SB) const {
  const Pose2 at = inverse(start_) * X_SB;
  if (segment_ % 2 == 1) return M_PI / 2 - sign_ * at.theta_rad;
  const double radius_m = course_.turn == "arc" ? course_.turn_radius_m : 0;
  return course_.side_m - 2 * radius_m - at.x_m;
}

double Driver::speed(double left, double top, double acceleration, double braking) {
  return speed_ = std::min({speed_ + acceleration * period_s_, top, std::sqrt(2 * braking * left)});
}

WheelSpeeds Driver::wheels(double v_mps, double w_radps) const {
  const double half_m = believed_.wheelbase_m / 2;
  return {(v_mps - w_radps * half_m) / believed_.left_radius_m, (v_mps + w_radps * half_m) / believed_.right_radius_m};
}

void Driver::next() {
  const double radius_m = course_.turn == "arc" ? course_.turn_radius_m : 0;
  if (segment_ % 2 == 0)
    start_ = start_ * Pose2{course_.side_m - 2 * radius_m, 0, 0};
  else
    start_ = start_ * arc(radius_m * M_PI / 2, sign_ * M_PI / 2);
  ++segment_;
  speed_ = 0;
  waited_ = 0;
  moving_ = true;
}

WheelSpeeds Driver::command(const Pose2& X_SB) {
  begins_ = moving_ && speed_ == 0;
  if (!moving_) {
    if (++waited_ >= int(std::lround(course_.dwell_s / period_s_))) next();
    return {};
  }
  const bool turn = segment_ % 2 == 1, in_place = turn && course_.turn != "arc";
  const double left = left_of_segment(X_SB);
  if (left < (turn ? kArrived_rad : kArrived_m)) {
    moving_ = false;
    return {};
  }
  if (in_place) {
    const double acceleration = course_.angular_acceleration_radps2;
    return wheels(0, sign_ * speed(left, course_.angular_speed_radps, acceleration, kGentle * acceleration));
  }
  if (turn) {
    const double top = std::min(course_.linear_speed_mps, course_.angular_speed_radps * course_.turn_radius_m);
    const double acceleration = course_.linear_acceleration_mps2;
    const double v = speed(left * course_.turn_radius_m, top, acceleration, acceleration);
    return wheels(v, sign_ * v / course_.turn_radius_m);
  }
  const Pose2 at = inverse(start_) * X_SB;
  const double acceleration = course_.linear_acceleration_mps2;
  const double v = speed(left, course_.linear_speed_mps, acceleration, acceleration);
  return wheels(v, -kHeadingGain_1ps * at.theta_rad - kAcrossGain_radpms * at.y_m);
}

}  // namespace umbsim::second_engine
