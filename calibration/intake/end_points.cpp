#include <algorithm>
#include <cmath>

#include "calibration/intake/parts.h"
#include "calibration/intake/refusal.h"
#include "calibration/intake/units.h"

namespace umbsim::intake {
namespace {

constexpr double kWrapped = 3;  // full turns that a heading at the end may lack

// Without a track a square must do for one: its sides and as many full turns as the end says.
void check_square(const std::string& directory, const RecordedRun& run, const Recording& recording,
                  double tracked_turn_rad) {
  const double laps = std::max(1.0, std::round(std::abs(tracked_turn_rad) / (2 * M_PI)));
  // Headings may be in degrees.
  const double around = laps > 20 ? 1 : laps;
  const double way = 4 * recording.path.side_m * around;
  const double turn = 2 * M_PI * around;
  const bool clockwise = std::abs(tracked_turn_rad) > kTurn_rad ? tracked_turn_rad < 0 : run.direction == "cw";
  const auto off = [&](const Counted& c) {
    return std::abs(std::log(std::max(c.way_m, 1e-9) / way)) +
           std::abs(std::log(std::max(std::abs(c.turn_rad), 1e-9) / turn)) + ((c.turn_rad < 0) == clockwise ? 0 : 0.8);
  };
  const Counted as_it_is = counted(run, recording.robot);
  if (std::min(as_it_is.left_m, as_it_is.right_m) < kDead * std::max(as_it_is.left_m, as_it_is.right_m)) {
    refuse(directory, run,
           fmt::format("the {} wheel hardly counts on a square: its counter is dead or its column is missing.",
                       as_it_is.left_m < as_it_is.right_m ? "left" : "right"));
  }
  for (const Wiring& w : wirings()) {
    if (off(as_it_is) > 1 && off(counted(run, recording.robot, w)) < 0.5)
      refuse(directory, run, fmt::format("{}.", w.meaning));
  }
  const double ratio = way / std::max(as_it_is.way_m, 1e-12);
  if (ratio < kScaleLow || ratio > kScaleHigh) {
    refuse(directory, run,
           fmt::format(
               "the square's way is {:.4g} times the wheels' ({:.4g} m against {:.4g} m): {}; or path.side_m is wrong.",
               ratio, way, as_it_is.way_m, why_lengths_differ(ratio, recording.robot, "path.side_m is")));
  }
  const double turns = turn / std::max(std::abs(as_it_is.turn_rad), 1e-12);
  if (turns > kTurnHigh || turns < kTurnLow) {
    refuse(directory, run,
           fmt::format("a square turns {:.3g} times as much as the wheels: {}.", turns, why_turns_differ(turns)));
  }
}

}  // namespace

void check_end_points(const std::string& directory, const RecordedRun& run, const Recording& recording) {
  const RecordedRobot& robot = recording.robot;
  const Pose2 tracked = inverse(run.truth.front().X_WB) * run.truth.back().X_WB;
  const double far = std::hypot(tracked.x_m, tracked.y_m);
  const Counted wheels = counted(run, robot);
  if (wheels.way_m == 0 && wheels.turn_rad == 0)
    refuse(directory, run, "no motion: the wheels did not turn. Leave the run out.");
  if (far < 1e-9 && std::abs(tracked.theta_rad) < 1e-9)
    refuse(directory, run,
           "start and end are the same pose to the last digit: the tracker saw nothing. Leave the run out.");
  if (recording.path.shape == "square") check_square(directory, run, recording, tracked.theta_rad);
  const double off = tracked.theta_rad - wheels.turn_rad;
  if (std::abs(wheels.turn_rad) > kTurn_rad &&
      std::abs(tracked.theta_rad + wheels.turn_rad) < 0.1 * std::abs(wheels.turn_rad)) {
    refuse(
        directory, run,
        fmt::format("the truth turns by {:.3g} rad, the wheels by {:.3g} rad: left_ticks and right_ticks are swapped; "
                    "exchange the columns (or theta_rad grows clockwise).",
                    tracked.theta_rad, wheels.turn_rad));
  }
  const double laps = std::round(off / (2 * M_PI));
  if (laps != 0 && std::abs(laps) <= kWrapped && std::abs(off - 2 * M_PI * laps) < 0.1 * std::abs(wheels.turn_rad)) {
    refuse(directory, run,
           fmt::format(
               "the truth turns by {:.3g} rad, the wheels by {:.3g} rad: theta_rad is not unwrapped; add {:g} times "
               "2 pi at the end.",
               tracked.theta_rad, wheels.turn_rad, -laps));
  }
  const double turns = std::abs(tracked.theta_rad / wheels.turn_rad);
  if (std::abs(wheels.turn_rad) > kTurn_rad && (turns > kTurnHigh || turns < kTurnLow)) {
    refuse(directory, run,
           fmt::format("the truth turns {:.3g} times as much as the wheels: {}.", turns, why_turns_differ(turns)));
  }
  if (far > 1.2 * wheels.way_m + kWay_m) {
    refuse(directory, run,
           fmt::format(
               "it ends {:.4g} m from its start, by a way of {:.4g} m: the truth is in millimetres or centimetres, or "
               "wheel_radius_m is too small.",
               far, wheels.way_m));
  }
}

}  // namespace umbsim::intake
