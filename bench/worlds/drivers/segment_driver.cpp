#include <algorithm>
#include <cmath>

#include "bench/worlds/drivers/kinds.h"

namespace umbsim::worlds {
namespace {

constexpr double kArrived_m = 0.001;
constexpr double kArrived_rad = 0.0015;
constexpr double kGentle = 2.0 / 3;  // turns on the spot brake more gently than they speed up
constexpr double kSlowest = 0.02;    // of the top speed: what creeps arrives some time

double extent(const Segment& s) { return s.length_m > 0 ? s.length_m : std::abs(s.angle_rad); }

}  // namespace

SegmentDriver::SegmentDriver(const DriverChoice& choice, const Way& way, const DriveGeometry& believed)
    : choice_(choice), way_(way), period_s_(1 / choice.rate_hz), believed_(believed) {
  way_.segments = Plan(way.limits, way.segments).segments();  // with their starts
}

double SegmentDriver::arrived(const Segment& s) const { return in_place(s) ? kArrived_rad : kArrived_m; }

// Arcs are measured by their heading, which counts full turns.
double SegmentDriver::left_of(const Segment& s, const Pose2& X_SB) const {
  if (s.angle_rad == 0) return s.length_m - (inverse(s.X_SB_start) * X_SB).x_m;
  const double turned = (X_SB.theta_rad - s.X_SB_start.theta_rad) / s.angle_rad;
  return (1 - turned) * extent(s);
}

double SegmentDriver::ramped(double left, double top, double acceleration, double braking) {
  const double most = std::sqrt(2 * braking * std::max(left, 0.0));
  return speed_ = std::max(kSlowest * top, std::min({speed_ + acceleration * period_s_, top, most}));
}

double SegmentDriver::top_speed(const Segment& s) const {
  if (in_place(s)) return way_.limits.angular_speed_radps;
  if (s.angle_rad == 0) return way_.limits.linear_speed_mps;
  return std::min(way_.limits.linear_speed_mps, way_.limits.angular_speed_radps * s.length_m / std::abs(s.angle_rad));
}

Pose2 SegmentDriver::reference(const Segment& s, double left) const {
  const double part = 1 - left / extent(s);
  return s.X_SB_start * arc(part * s.length_m, part * s.angle_rad);
}

// On an arc the heading is its own measure of the way, so that the line is held by the distance from the centre.
Pose2 SegmentDriver::error(const Segment& s, double left, const Pose2& X_SB) const {
  return inverse(reference(s, left)) * X_SB;
}

Twist SegmentDriver::proportional(const Segment& s, double left, const Pose2& X_SB) {
  const double top = top_speed(s);
  const double sign = s.angle_rad < 0 ? -1 : 1;
  if (in_place(s)) {
    const double acceleration = way_.limits.angular_acceleration_radps2;
    return {0, sign * ramped(left, top, acceleration, kGentle * acceleration)};
  }
  const double acceleration = way_.limits.linear_acceleration_mps2;
  const double v = ramped(left, top, acceleration, acceleration);
  const Pose2 e = error(s, left, X_SB);
  return {v,
          v * s.angle_rad / s.length_m - choice_.heading_gain_1ps * e.theta_rad - choice_.across_gain_radpms * e.y_m};
}

WheelSpeeds SegmentDriver::command(double time_s, const Seen& seen) {
  const Pose2 X_SB = look(time_s, seen);
  if (done()) return {};
  if (!moving_) {
    if (++waited_ >= int(std::lround(way_.limits.dwell_s / period_s_))) {
      ++segment_;
      speed_ = 0;
      waited_ = 0;
      moving_ = true;
    }
    return {};
  }
  const Segment& s = way_.segments[std::size_t(segment_)];
  const double left = left_of(s, X_SB);
  if (left < arrived(s)) {
    moving_ = false;
    return {};
  }
  const Twist t = steer(s, left, X_SB);
  const double half_m = believed_.wheelbase_m / 2;
  return {(t.v_mps - t.w_radps * half_m) / believed_.left_radius_m,
          (t.v_mps + t.w_radps * half_m) / believed_.right_radius_m};
}

}  // namespace umbsim::worlds
