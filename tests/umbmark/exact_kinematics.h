#pragma once

#include <cmath>
#include <complex>
#include <string>

#include "recording/recording.h"
#include "umbmark/figures.h"

namespace umbsim::testing {

/// A robot as it really is.
struct TrueRobot {
  double left_radius_m = 0.075;
  double right_radius_m = 0.075;
  double wheelbase_m = 0.340;

  /// With the nominal mean radius.
  static TrueRobot with(double e_d, double e_b, double radius_m = 0.075, double wheelbase_m = 0.340) {
    return {2 * radius_m / (1 + e_d), 2 * radius_m * e_d / (1 + e_d), e_b * wheelbase_m};
  }
};

/// Poses as complex numbers, with circles by their centre: nothing of the program's own pose arithmetic.
struct PlanePose {
  std::complex<double> p = 0;
  double heading = 0;

  void roll(double left_m, double right_m, double wheelbase_m) {
    const std::complex<double> i(0, 1);
    const double turn = (right_m - left_m) / wheelbase_m;
    if (turn == 0) {
      p += (left_m + right_m) / 2 * std::exp(i * heading);
    } else {
      const std::complex<double> to_centre = i * std::exp(i * heading) * ((left_m + right_m) / 2 / turn);
      p += to_centre - to_centre * std::exp(i * turn);
    }
    heading += turn;
  }
};

constexpr double kTicks = 1e9;  // per revolution: half a tick is 2e-10 m

/// The squares that a robot drives whose odometry (`believed`) is sure to have driven them exactly: four legs and four
/// turns in place, with ticks and absolute poses at their ends. `extra_turn_rad` is added to the true heading on the
/// first leg: bumps, towards the inner side.
inline RecordedRun square_run(const TrueRobot& robot, const OdometryParameters& believed, bool cw, double side_m = 4,
                              double bump_turn_rad = 0, const PlanePose& start = {}, int laps = 1) {
  RecordedRun run;
  run.id = run.direction = cw ? "cw" : "ccw";
  const double sense = cw ? -1 : 1;
  PlanePose truth = start;
  double left_ticks = 0, right_ticks = 0, time_s = 0;
  const auto record = [&] {
    run.encoders.push_back({time_s, std::llround(left_ticks), std::llround(right_ticks), 0, 0});
    run.truth.push_back({time_s, {truth.p.real(), truth.p.imag(), truth.heading}});
    time_s += 1;
  };
  const auto move = [&](double left_believed_m, double right_believed_m) {
    const double left_rad = left_believed_m / believed.left_radius_m;
    const double right_rad = right_believed_m / believed.right_radius_m;
    left_ticks += left_rad / (2 * M_PI) * believed.ticks_per_revolution;
    right_ticks += right_rad / (2 * M_PI) * believed.ticks_per_revolution;
    truth.roll(left_rad * robot.left_radius_m, right_rad * robot.right_radius_m, robot.wheelbase_m);
  };
  record();
  for (int leg = 0; leg < 4 * laps; ++leg) {
    move(side_m, side_m);
    if (leg == 0) truth.heading += sense * bump_turn_rad;
    record();
    const double quarter_m = sense * M_PI / 2 * believed.wheelbase_m / 2;
    move(-quarter_m, quarter_m);
    record();
  }
  return run;
}

inline Recording squares(const TrueRobot& robot, const OdometryParameters& believed, double side_m = 4, int laps = 1) {
  Recording recording;
  recording.path.side_m = side_m;
  recording.runs = {square_run(robot, believed, true, side_m, 0, {}, laps),
                    square_run(robot, believed, false, side_m, 0, {}, laps)};
  return recording;
}

inline OdometryParameters nominal_odometry() { return {0.075, 0.075, 0.340, kTicks}; }

}  // namespace umbsim::testing
