#pragma once

#include <random>
#include <utility>
#include <vector>

#include "calibration/methods/runs.h"
#include "tests/umbmark/exact_kinematics.h"

namespace umbsim::testing {

/// Ways of both wheels that the odometry believes in, one after the other.
using Moves = std::vector<std::pair<double, double>>;

inline Moves square_moves(bool cw, double side_m, double believed_wheelbase_m) {
  Moves moves;
  const double quarter_m = (cw ? -1 : 1) * M_PI / 2 * believed_wheelbase_m / 2;
  for (int leg = 0; leg < 4; ++leg) moves.insert(moves.end(), {{side_m, side_m}, {-quarter_m, quarter_m}});
  return moves;
}

/// An arc of the radius, by `angle_rad` (ccw positive).
inline std::pair<double, double> arc_move(double radius_m, double angle_rad, double believed_wheelbase_m) {
  const double half = believed_wheelbase_m / 2 * angle_rad;
  return {radius_m * std::abs(angle_rad) - half, radius_m * std::abs(angle_rad) + half};
}

/// How a tracker errs: the pose of its frame on the robot and in the world, its clock, its noise.
struct TestTracker {
  double heading_rad = 0, marker_x_m = 0, marker_y_m = 0;
  double clock_offset_s = 0, clock_rate = 0;  ///< encoder time = truth time + offset + rate * time since the first pose
  double position_sd_m = 0, heading_sd_rad = 0;
  double wheel_noise = 0;  ///< of either wheel, m per sqrt(m)
};

/// Drives the moves at 0.25 m/s of the faster wheel with exact kinematics, 20 readings and poses a second.
inline RecordedRun tracked_run(const std::string& id, const std::string& direction, const TrueRobot& robot,
                               const OdometryParameters& believed, const Moves& moves, const TestTracker& tracker = {},
                               unsigned seed = 1) {
  constexpr double kStep_s = 0.05, kSpeed_mps = 0.25;
  std::mt19937 bits(seed);
  std::normal_distribution<double> normal;
  RecordedRun run;
  run.id = id;
  run.direction = direction;
  double left_rad = 0, right_rad = 0, time_s = 0;
  std::vector<PlanePose> poses{{}};
  const auto count = [&] {
    const double k = believed.ticks_per_revolution / (2 * M_PI);
    run.encoders.push_back({time_s, std::llround(k * left_rad), std::llround(k * right_rad), 0, 0});
  };
  count();
  for (const auto& [left, right] : moves) {
    const int steps = std::max(1, int(std::ceil(std::max(std::abs(left), std::abs(right)) / (kSpeed_mps * kStep_s))));
    for (int i = 0; i < steps; ++i) {
      const double l = left / steps / believed.left_radius_m, r = right / steps / believed.right_radius_m;
      left_rad += l, right_rad += r, time_s += kStep_s;
      PlanePose next = poses.back();
      const auto noisy = [&](double way) {
        return way + tracker.wheel_noise * std::sqrt(std::abs(way)) * normal(bits);
      };
      next.roll(noisy(l * robot.left_radius_m), noisy(r * robot.right_radius_m), robot.wheelbase_m);
      poses.push_back(next);
      count();
    }
  }
  // The tracker looks at moments of its own clock.
  const std::complex<double> i(0, 1);
  for (double own_s = tracker.clock_offset_s == 0 ? 0 : std::max(0.0, 0.01 - tracker.clock_offset_s);;
       own_s += kStep_s) {
    const double first_s = run.truth.empty() ? own_s : run.truth.front().time_s;
    const double at = (own_s + tracker.clock_offset_s + tracker.clock_rate * (own_s - first_s)) / kStep_s;
    if (at < 0 || at > double(poses.size() - 1) + 1e-6) break;
    const std::size_t k = std::min(std::size_t(at + 1e-6), poses.size() - 2);
    // Between two readings the wheels turn evenly: the part of the arc by the same rolling.
    PlanePose p = poses[k];
    const double share = at - double(k), dtheta = poses[k + 1].heading - p.heading;
    const double chord = std::abs(poses[k + 1].p - p.p);
    const double sign = std::real((poses[k + 1].p - p.p) * std::exp(-i * (p.heading + dtheta / 2))) < 0 ? -1 : 1;
    const double way = sign * chord / sinc(dtheta / 2);
    p.roll(share * (way - dtheta * robot.wheelbase_m / 2), share * (way + dtheta * robot.wheelbase_m / 2),
           robot.wheelbase_m);
    const std::complex<double> marker =
        p.p + std::exp(i * p.heading) * std::complex<double>(tracker.marker_x_m, tracker.marker_y_m);
    run.truth.push_back(
        {own_s,
         {marker.real() + tracker.position_sd_m * normal(bits), marker.imag() + tracker.position_sd_m * normal(bits),
          p.heading + tracker.heading_rad + tracker.heading_sd_rad * normal(bits)}});
  }
  return run;
}

inline Recording recording_of(const std::string& shape, double side_m, const OdometryParameters& believed,
                              std::vector<RecordedRun> runs) {
  Recording r;
  r.path.shape = shape;
  r.path.side_m = side_m;
  r.robot.wheel_radius_m = believed.left_radius_m;
  r.robot.wheelbase_m = believed.wheelbase_m;
  r.robot.ticks_per_revolution = believed.ticks_per_revolution;
  r.encoder_rate_hz = 20;
  r.runs = std::move(runs);
  return r;
}

/// Squares of both directions, `pairs` of each.
inline Recording tracked_squares(const TrueRobot& robot, const OdometryParameters& believed, int pairs,
                                 const TestTracker& tracker = {}, double side_m = 2) {
  std::vector<RecordedRun> runs;
  for (int i = 0; i < pairs; ++i) {
    for (const bool cw : {true, false}) {
      runs.push_back(tracked_run((cw ? "cw-" : "ccw-") + std::to_string(i + 1), cw ? "cw" : "ccw", robot, believed,
                                 square_moves(cw, side_m, believed.wheelbase_m), tracker, unsigned(2 * i + cw)));
    }
  }
  return recording_of("square", side_m, believed, std::move(runs));
}

/// Two circles round in either direction.
inline Recording tracked_circles(const TrueRobot& robot, const OdometryParameters& believed, double radius_m = 0.8,
                                 const TestTracker& tracker = {}) {
  std::vector<RecordedRun> runs;
  for (const bool cw : {true, false}) {
    runs.push_back(tracked_run(cw ? "cw-1" : "ccw-1", cw ? "cw" : "ccw", robot, believed,
                               {arc_move(radius_m, (cw ? -1 : 1) * 2 * M_PI, believed.wheelbase_m)}, tracker));
  }
  return recording_of("circle", 0, believed, std::move(runs));
}

/// Only the poses at start and end.
inline Recording end_points(Recording recording) {
  recording.truth_kind = "endpoints";
  for (RecordedRun& run : recording.runs) run.truth = {run.truth.front(), run.truth.back()};
  return recording;
}

}  // namespace umbsim::testing
