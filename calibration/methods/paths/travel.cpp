#include "calibration/methods/paths/travel.h"

#include <cmath>

#include "recording/encoder_clock.h"

namespace umbsim::calibration {
namespace {

// d sinc(x) / dx.
double sinc_slope(double x) { return std::abs(x) < 1e-4 ? -x / 3 : (std::cos(x) - std::sin(x) / x) / x; }

// An error of the pose, moved as it would move if the robot drove back to the start: there errors of all arcs add up.
Eigen::Vector3d at_start(const Eigen::Vector3d& error, const Pose2& pose) {
  return {error[0] + pose.y_m * error[2], error[1] - pose.x_m * error[2], error[2]};
}

// What a scrub of one would take of both ways.
RolledWays taken_by_scrub(const OdometryParameters& o, const RolledWays& counted) {
  OdometryParameters one = o;
  one.scrub = 1;
  const RolledWays left = over_floor(one, counted);
  return {left.left_m - counted.left_m, left.right_m - counted.right_m};
}

// Goes on from `t`, whose errors are those at the start, over an arc of both wheels.
void roll(Travel& t, const RolledWays& counted, const OdometryParameters& odometry) {
  const RolledWays scrub = taken_by_scrub(odometry, counted);
  const double left_m = counted.left_m + odometry.scrub * scrub.left_m;
  const double right_m = counted.right_m + odometry.scrub * scrub.right_m;
  const double wheelbase_m = odometry.wheelbase_m;
  const double ds = (left_m + right_m) / 2, turn = (right_m - left_m) / wheelbase_m;
  const double of_arc = sinc(turn / 2), chord = ds * of_arc, middle = t.pose.theta_rad + turn / 2;
  const double c = std::cos(middle), s = std::sin(middle);
  t.pose = {t.pose.x_m + chord * c, t.pose.y_m + chord * s, t.pose.theta_rad + turn};
  const double slope = ds * sinc_slope(turn / 2) / 2;
  const Eigen::Vector3d by_way(of_arc * c, of_arc * s, 0);
  const Eigen::Vector3d by_turn = at_start({slope * c - chord / 2 * s, slope * s + chord / 2 * c, 1}, t.pose);
  const Eigen::Vector3d by_left = by_way / 2 - by_turn / wheelbase_m, by_right = by_way / 2 + by_turn / wheelbase_m;
  t.by_factor.col(0) += by_left * left_m;
  t.by_factor.col(1) += by_right * right_m;
  t.by_factor.col(2) -= by_turn * turn;
  t.by_scrub += by_left * scrub.left_m + by_right * scrub.right_m;
  t.left_noise.noalias() += by_left * (by_left * std::abs(left_m)).transpose();
  t.right_noise.noalias() += by_right * (by_right * std::abs(right_m)).transpose();
  t.left_m += left_m;
  t.right_m += right_m;
}

// The same with errors of the pose where the robot is.
Travel carried(Travel t) {
  const Eigen::Matrix3d F = transition({}, t.pose);
  t.by_factor = F * t.by_factor;
  t.by_scrub = F * t.by_scrub;
  t.left_noise = F * t.left_noise * F.transpose();
  t.right_noise = F * t.right_noise * F.transpose();
  return t;
}

}  // namespace

Eigen::Matrix3d transition(const Pose2& from, const Pose2& to) {
  Eigen::Matrix3d F = Eigen::Matrix3d::Identity();
  F(0, 2) = -(to.y_m - from.y_m);
  F(1, 2) = to.x_m - from.x_m;
  return F;
}

std::vector<Travel> travel(const RecordedRun& run, const OdometryParameters& odometry,
                           const std::vector<double>& times_s) {
  const std::vector<EncoderSample>& s = run.encoders;
  const double kl = odometry.left_metres_per_tick(), kr = odometry.right_metres_per_tick();
  std::vector<Travel> result;
  result.reserve(times_s.size());
  EncoderClock clock(s);
  Travel at;
  std::size_t i = 0;
  for (const double time_s : times_s) {
    const EncoderClock::Moment m = clock.at(time_s);
    for (; i < m.before; ++i) {
      roll(at,
           {kl * double(s[i + 1].left_ticks - s[i].left_ticks), kr * double(s[i + 1].right_ticks - s[i].right_ticks)},
           odometry);
    }
    const double left_m = kl * double(s[i + 1].left_ticks - s[i].left_ticks);
    const double right_m = kr * double(s[i + 1].right_ticks - s[i].right_ticks);
    Travel part = at;
    if (m.share > 0) roll(part, {m.share * left_m, m.share * right_m}, odometry);
    const double dt = s[i + 1].time_s - s[i].time_s;
    const double v = (left_m + right_m) / 2 / dt;
    part.velocity = {v * std::cos(part.pose.theta_rad), v * std::sin(part.pose.theta_rad),
                     (right_m - left_m) / odometry.wheelbase_m / dt};
    result.push_back(carried(part));
  }
  return result;
}

Travel between(const Travel& a, const Travel& b) {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();  // into the frame of a
  const double c = std::cos(a.pose.theta_rad), s = std::sin(a.pose.theta_rad);
  R(0, 0) = c, R(0, 1) = s, R(1, 0) = -s, R(1, 1) = c;
  const Eigen::Matrix3d F = transition(a.pose, b.pose);
  Travel t;
  t.pose = inverse(a.pose) * b.pose;
  t.by_factor = R * (b.by_factor - F * a.by_factor);
  t.by_scrub = R * (b.by_scrub - F * a.by_scrub);
  t.left_noise = R * (b.left_noise - F * a.left_noise * F.transpose()) * R.transpose();
  t.right_noise = R * (b.right_noise - F * a.right_noise * F.transpose()) * R.transpose();
  t.left_m = b.left_m - a.left_m;
  t.right_m = b.right_m - a.right_m;
  return t;
}

}  // namespace umbsim::calibration
