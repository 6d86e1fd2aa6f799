#include "umbmark/course.h"

#include <algorithm>
#include <cmath>

#include "umbmark/control_loop.h"

namespace umbsim {
namespace {

// What the profile runs over: metres, or radians when turning in place.
double extent(const Segment& s) { return s.length_m > 0 ? s.length_m : std::abs(s.angle_rad); }

// A trapezoidal speed profile, or a triangle where the speed is not reached.
void set_profile(Segment& s, const Course& course) {
  const bool rolling = s.length_m > 0;
  double top = rolling ? course.linear_speed_mps : course.angular_speed_radps;
  if (rolling && s.angle_rad != 0) top = std::min(top, course.angular_speed_radps * s.length_m / std::abs(s.angle_rad));
  const double acceleration = rolling ? course.linear_acceleration_mps2 : course.angular_acceleration_radps2;
  s.ramp_s = std::min(top / acceleration, std::sqrt(extent(s) / acceleration));
  s.speed = acceleration * s.ramp_s;
  s.duration_s = extent(s) / s.speed + s.ramp_s;
}

double extent_at(const Segment& s, double t) {
  t = std::clamp(t, 0.0, s.duration_s);
  const double left_s = s.duration_s - t;
  if (t < s.ramp_s) return s.speed / s.ramp_s * t * t / 2;
  if (left_s < s.ramp_s) return extent(s) - s.speed / s.ramp_s * left_s * left_s / 2;
  return s.speed * (t - s.ramp_s / 2);
}

double part_at(const Segment& s, double time_s) { return extent_at(s, time_s - s.start_s) / extent(s); }

Pose2 pose_at(const Segment& s, double part) { return s.X_SB_start * arc(part * s.length_m, part * s.angle_rad); }

// By its series where the angle is small; the next term is below round-off.
double cosine(double angle_rad) {
  const double a2 = angle_rad * angle_rad;
  return a2 < 0.01 ? 1 - a2 / 2 * (1 - a2 / 12 * (1 - a2 / 30 * (1 - a2 / 56))) : std::cos(angle_rad);
}

// X_BC of X_AB and X_AC: inverse(X_AB) * X_AC with one sine and cosine.
Pose2 seen_from(const Pose2& X_AB, const Pose2& X_AC) {
  const double c = std::cos(X_AB.theta_rad), s = std::sin(X_AB.theta_rad);
  const double x_m = X_AC.x_m - X_AB.x_m, y_m = X_AC.y_m - X_AB.y_m;
  return {c * x_m + s * y_m, c * y_m - s * x_m, X_AC.theta_rad - X_AB.theta_rad};
}

struct Feed {
  double v_mps, w_radps;
};

// `error`: of the robot, which sees the reference there.
WheelSpeeds corrected(const Feed& feed, const Pose2& error, const DriveGeometry& geometry) {
  const double v = feed.v_mps * cosine(error.theta_rad) + kDriver.along * error.x_m;
  const double w = feed.w_radps + kDriver.heading * error.theta_rad + across_gain(feed.v_mps) * error.y_m;
  const double half_m = geometry.wheelbase_m / 2;
  return {(v - w * half_m) / geometry.left_radius_m, (v + w * half_m) / geometry.right_radius_m};
}

}  // namespace

Plan::Plan(const Course& course, Direction direction) : Plan(course, shapes_of(course, direction)) {}

Plan::Plan(const Course& course, const std::vector<Segment>& shapes) : segments_(shapes) {
  Pose2 X_SB;
  for (Segment& segment : segments_) {
    set_profile(segment, course);
    segment.start_s = duration_s_;
    segment.X_SB_start = X_SB;
    X_SB = X_SB * arc(segment.length_m, segment.angle_rad);
    duration_s_ += segment.duration_s + course.dwell_s;
  }
}

std::optional<std::size_t> Plan::leg_segment(int leg) const {
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    if (segments_[i].kind == Segment::Kind::leg && segments_[i].leg == leg) return i;
  }
  return std::nullopt;
}

int Plan::segment_at(double time_s, int hint) const {
  int i = std::clamp(hint, 0, int(segments_.size()) - 1);
  while (i > 0 && segments_[i].start_s > time_s) --i;
  while (i + 1 < int(segments_.size()) && segments_[i + 1].start_s <= time_s) ++i;
  return i;
}

Reference Plan::at(double time_s, int segment_hint) const {
  const int i = segment_at(time_s, segment_hint);
  return {pose_at(segments_[i], part_at(segments_[i], time_s)), i};
}

WheelSpeeds follow(const Pose2& X_SR_now, const Pose2& X_SR_next, double period_s, const Pose2& X_SB,
                   const DriveGeometry& geometry) {
  const Pose2 motion = seen_from(X_SR_now, X_SR_next);
  const double turn = motion.theta_rad;
  const double way_m = motion.x_m / sinc(turn);  // x of an arc is way sinc(turn / 2) cos(turn / 2)
  return corrected({way_m / period_s, turn / period_s}, seen_from(X_SB, X_SR_now), geometry);
}

// As follow(), where the reference stays on one arc without its poses.
WheelSpeeds drive(const Plan& plan, double time_s, double period_s, const Pose2& X_SB, const DriveGeometry& geometry,
                  int segment_hint) {
  const int now = plan.segment_at(time_s, segment_hint), next = plan.segment_at(time_s + period_s, now);
  const Segment& s = plan.segments()[std::size_t(now)];
  const double part = part_at(s, time_s);
  const Pose2 X_SR = pose_at(s, part);
  if (next != now) return follow(X_SR, plan.at(time_s + period_s, next).X_SB, period_s, X_SB, geometry);
  const double rate = (part_at(s, time_s + period_s) - part) / period_s;
  return corrected({rate * s.length_m, rate * s.angle_rad}, seen_from(X_SB, X_SR), geometry);
}

}  // namespace umbsim
