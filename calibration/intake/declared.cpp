#include <algorithm>
#include <cmath>
#include <optional>

#include "calibration/intake/parts.h"
#include "calibration/intake/refusal.h"
#include "calibration/intake/units.h"
#include "odometry/dead_reckoning.h"

namespace umbsim::intake {
namespace {

constexpr double kFarOff = 5;  // a speed, a side: wrong units, not another robot

// The larger side of the box that the wheels say they drove through.
double counted_extent_m(const RecordedRun& run, const RecordedRobot& robot) {
  DeadReckoning odometry({robot.wheel_radius_m, robot.wheel_radius_m, robot.wheelbase_m, robot.ticks_per_revolution},
                         {}, run.encoders.front().left_ticks, run.encoders.front().right_ticks);
  double x[2] = {0, 0}, y[2] = {0, 0};
  for (const EncoderSample& s : run.encoders) {
    odometry.update(s.left_ticks, s.right_ticks);
    x[0] = std::min(x[0], odometry.pose().x_m);
    x[1] = std::max(x[1], odometry.pose().x_m);
    y[0] = std::min(y[0], odometry.pose().y_m);
    y[1] = std::max(y[1], odometry.pose().y_m);
  }
  return std::max(x[1] - x[0], y[1] - y[0]);
}

// Near the fastest that the robot went for a second or more.
double counted_speed_mps(const RecordedRun& run, const RecordedRobot& robot) {
  const double k = metres_per_tick(robot) / 2;
  double fastest = 0;
  std::size_t from = 0;
  for (std::size_t i = 0; i < run.encoders.size(); ++i) {
    const EncoderSample& b = run.encoders[i];
    if (b.time_s - run.encoders[from].time_s < 1) continue;
    while (b.time_s - run.encoders[from + 1].time_s >= 1) ++from;
    const EncoderSample& a = run.encoders[from];
    fastest = std::max(fastest, k * std::abs(double(b.left_ticks + b.right_ticks - a.left_ticks - a.right_ticks)) /
                                    (b.time_s - a.time_s));
  }
  return fastest;
}

}  // namespace

void check_commands(const std::string& directory, const RecordedRun& run, const RecordedRobot& robot) {
  if (!run.has_commands) return;
  Agreement own, difference;
  double left = 0, right = 0;  // commanded angles of this piece
  std::size_t from = 0;
  for (std::size_t i = 1; i < run.encoders.size(); ++i) {
    const EncoderSample& a = run.encoders[from];
    const EncoderSample& b = run.encoders[i];
    const double dt = b.time_s - run.encoders[i - 1].time_s;
    left += dt * run.encoders[i - 1].left_command_radps;
    right += dt * run.encoders[i - 1].right_command_radps;
    if (b.time_s - a.time_s < kPiece_s) continue;
    const double k = 2 * M_PI / robot.ticks_per_revolution;
    const double turned_left = k * double(b.left_ticks - a.left_ticks);
    const double turned_right = k * double(b.right_ticks - a.right_ticks);
    own.add(left, turned_left);
    own.add(right, turned_right);
    // What is alike in both says nothing of which is which.
    difference.add(right - left, turned_right - turned_left);
    left = right = 0;
    from = i;
  }
  if (own.tracked2 == 0) return;
  if (own.counted2 == 0) {
    refuse(directory, run,
           "all commands are zero, though the wheels turn: leave out the columns left_command_radps and "
           "right_command_radps.");
  }
  if (own.product > 0 && difference.product < -0.5 * std::sqrt(difference.counted2 * difference.tracked2) &&
      difference.tracked2 > 0.01 * own.tracked2) {
    refuse(directory, run, "left_command_radps and right_command_radps are swapped: exchange the columns.");
  }
  if (own.product < 0) {
    refuse(directory, run,
           "the commands have the wrong sign: the wheels turn against them. Negate left_command_radps and "
           "right_command_radps.");
  }
  const double gain = std::sqrt(own.tracked2 / own.counted2);
  if (gain > kScaleLow && gain < kScaleHigh) return;
  refuse(
      directory, run,
      fmt::format("the wheels turn {:.4g} times as fast as commanded: {}.", gain,
                  likeliest(gain,
                            {{1 / robot.wheel_radius_m, "the commands are in m/s (divide by wheel_radius_m)"},
                             {0.001 / robot.wheel_radius_m, "the commands are in mm/s (divide by 1000 wheel_radius_m)"},
                             {2 * M_PI / 60, "the commands are in revolutions per minute (multiply by 2 pi / 60)"},
                             {2 * M_PI, "the commands are in revolutions per second (multiply by 2 pi)"},
                             {M_PI / 180, "the commands are in degrees per second (multiply by pi / 180)"},
                             {2 * M_PI / robot.ticks_per_revolution,
                              "the commands are in counts per second (multiply by 2 pi / ticks_per_revolution)"},
                             {10, "the commands are 10 times too small"},
                             {0.1, "the commands are 10 times too large"},
                             {1000, "the commands are 1000 times too small"},
                             {0.001, "the commands are 1000 times too large"}},
                            "left_command_radps and right_command_radps must be in rad/s; leave them out if unknown")));
}

void check_path(const std::string& directory, const RecordedRun& run, const Recording& recording) {
  const RecordedPath& path = recording.path;
  const double turned = counted(run, recording.robot).turn_rad;
  const bool one_sense = path.shape == "square" || path.shape == "circle";
  if (one_sense && run.direction != "free" && std::abs(turned) > 3 && (turned > 0) != (run.direction == "ccw")) {
    refuse(
        directory, run,
        fmt::format("its direction is {}, but the robot turned {} by {:.0f} degrees: set direction: {}.", run.direction,
                    turned > 0 ? "left" : "right", std::abs(turned) * 180 / M_PI, turned > 0 ? "ccw" : "cw"));
  }
  const auto far_off = [](double ratio) { return ratio > kFarOff || ratio < 1 / kFarOff; };
  const auto wrong_by = [](double ratio) {
    return likeliest(ratio,
                     {{10, "10 times too small"},
                      {100, "in other units (multiply by 100)"},
                      {1000, "in other units (multiply by 1000)"},
                      {0.1, "10 times too large"},
                      {0.01, "in centimetres (divide by 100)"},
                      {0.001, "in millimetres (divide by 1000)"}},
                     "not that of this run");
  };
  if (path.shape == "square" && std::abs(turned) > 3) {
    const double side = counted_extent_m(run, recording.robot);
    if (far_off(side / path.side_m)) {
      refuse(directory, run,
             fmt::format("the robot drove a square of {:.3g} m, path.side_m says {:.6g} m: it is {}.", side,
                         path.side_m, wrong_by(side / path.side_m)));
    }
  }
  const std::optional<double> asked = run.linear_speed_mps ? run.linear_speed_mps : path.linear_speed_mps;
  if (!asked) return;
  const double speed = counted_speed_mps(run, recording.robot);
  if (speed > 0 && far_off(speed / *asked)) {
    refuse(directory, run,
           fmt::format(
               "the robot drove at up to {:.3g} m/s, linear_speed_mps says {:.6g} m/s: it is {}, or time_s is not in "
               "seconds.",
               speed, *asked, wrong_by(speed / *asked)));
  }
}

}  // namespace umbsim::intake
