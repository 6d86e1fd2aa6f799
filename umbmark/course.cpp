#include "umbmark/course.h"

#include <algorithm>
#include <cmath>

namespace umbsim {
namespace {

// A trapezoidal speed profile over `distance` > 0, or a triangle where the speed is not reached.
struct Profile {
  double ramp_s = 0;
  double speed = 0;
  double duration_s = 0;

  Profile(double distance, double max_speed, double acceleration) {
    ramp_s = std::min(max_speed / acceleration, std::sqrt(distance / acceleration));
    speed = acceleration * ramp_s;
    duration_s = distance / speed + ramp_s;
  }
  double distance(double t) const {
    t = std::clamp(t, 0.0, duration_s);
    const double acceleration = speed / ramp_s;
    if (t < ramp_s) return acceleration * t * t / 2;
    if (t > duration_s - ramp_s) {
      const double left_s = duration_s - t;
      return speed * (duration_s - ramp_s) - acceleration * left_s * left_s / 2;
    }
    return speed * (t - ramp_s / 2);
  }
};

Profile profile(const Segment& segment, const Course& course) {
  if (segment.length_m > 0) {
    const double radius_m = std::abs(segment.length_m / std::max(std::abs(segment.angle_rad), 1e-12));
    const double speed = std::min(course.linear_speed_mps, course.angular_speed_radps * radius_m);
    return {segment.length_m, speed, course.linear_acceleration_mps2};
  }
  return {std::abs(segment.angle_rad), course.angular_speed_radps, course.angular_acceleration_radps2};
}

// Gains of the pose correction, per second (heading, along) and per metre and second (across).
constexpr double kAlong = 4;
constexpr double kHeading = 6;
constexpr double kAcross = 8;

}  // namespace

Plan::Plan(const Course& course, Direction direction) : course_(course) {
  const bool arc_turn = course.turn == "arc";
  const double turn_rad = (direction == Direction::ccw ? 1 : -1) * M_PI / 2;
  const double leg_m = arc_turn ? course.side_m - 2 * course.turn_radius_m : course.side_m;
  Pose2 X_SB;
  for (int leg = 1; leg <= 4 * course.laps; ++leg) {
    Segment straight{Segment::Kind::leg, leg, leg_m, 0, 0, 0, {}};
    Segment turn{Segment::Kind::turn, leg, arc_turn ? course.turn_radius_m * M_PI / 2 : 0, turn_rad, 0, 0, {}};
    for (Segment* segment : {&straight, &turn}) {
      segment->duration_s = profile(*segment, course).duration_s;
      segment->start_s = duration_s_;
      segment->X_SB_start = X_SB;
      X_SB = X_SB * arc(segment->length_m, segment->angle_rad);
      duration_s_ += segment->duration_s + course.dwell_s;
      segments_.push_back(*segment);
    }
  }
}

Reference Plan::at(double time_s, int segment_hint) const {
  int i = std::clamp(segment_hint, 0, int(segments_.size()) - 1);
  while (i > 0 && segments_[i].start_s > time_s) --i;
  while (i + 1 < int(segments_.size()) && segments_[i + 1].start_s <= time_s) ++i;
  const Segment& s = segments_[i];
  const Profile p = profile(s, course_);
  const double total = s.length_m > 0 ? s.length_m : std::abs(s.angle_rad);
  const double part = p.distance(time_s - s.start_s) / total;
  return {s.X_SB_start * arc(part * s.length_m, part * s.angle_rad), i};
}

WheelSpeeds drive(const Plan& plan, double time_s, double period_s, const Pose2& X_SB, const DriveGeometry& geometry,
                  int segment_hint) {
  const Reference now = plan.at(time_s, segment_hint);
  const Reference next = plan.at(time_s + period_s, now.segment);
  const Pose2 motion = inverse(now.X_SB) * next.X_SB;
  const double turn = motion.theta_rad;
  const double feed_v = motion.x_m / (sinc(turn / 2) * std::cos(turn / 2)) / period_s;
  const double feed_w = turn / period_s;

  const Pose2 error = inverse(X_SB) * now.X_SB;
  const double v = feed_v * std::cos(error.theta_rad) + kAlong * error.x_m;
  const double w = feed_w + kHeading * error.theta_rad + kAcross * feed_v * error.y_m;
  const double half_m = geometry.wheelbase_m / 2;
  return {(v - w * half_m) / geometry.left_radius_m, (v + w * half_m) / geometry.right_radius_m};
}

}  // namespace umbsim
