#include "exchange/import/whole_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/error.h"
#include "exchange/import/truth/clock_offset.h"
#include "exchange/import/truth/interpolate.h"
#include "exchange/import/wheels/counts.h"
#include "exchange/import/wheels/wheel_commands.h"
#include "recording/csv.h"

namespace umbsim::exchange {
namespace {

constexpr double kEdge_s = 1;  // kept at either end, for clocks that differ a little

double seconds(Nanoseconds t) { return double(t) * 1e-9; }

// Counts per revolution: of the options, of the angles' steps, or finer than any encoder.
void find_resolution(const std::vector<double>& left, const std::vector<double>& right, RecordedRobot& robot,
                     std::vector<std::string>& found) {
  if (robot.ticks_per_revolution > 0) return;
  const double a = resolution(left), b = resolution(right);
  if (a > 0 && b > 0 && std::abs(a / b - 1) < 1e-3) {
    robot.ticks_per_revolution = a == std::round(a) || b != std::round(b) ? a : b;
    found.push_back(
        fmt::format("counts: the angles come in steps of 1/{:.6g} of a revolution; say "
                    "--ticks-per-revolution if the encoder's is another",
                    robot.ticks_per_revolution));
    return;
  }
  robot.ticks_per_revolution = kFineCounts;
  found.push_back(
      fmt::format("counts: the wheels' numbers have no steps of an encoder; written as counts of 1/{:g} of a "
                  "revolution (--ticks-per-revolution for others)",
                  kFineCounts));
}

// Speeds as angular ones of the wheel.
double command_scale(WheelUnit unit, double radius_m) {
  switch (unit) {
    case WheelUnit::degps:
      return M_PI / 180;
    case WheelUnit::rpm:
      return 2 * M_PI / 60;
    case WheelUnit::mps:
      return 1 / radius_m;
    case WheelUnit::mmps:
      return 0.001 / radius_m;
    default:
      return 1;
  }
}

void add_encoders(const Log& log, RecordedRobot& robot, Nanoseconds zero, RecordedRun& run,
                  std::vector<std::string>& found) {
  const std::vector<double> left = turned(log.left, robot.wheel_radius_m, found);
  const std::vector<double> right = turned(log.right, robot.wheel_radius_m, found);
  find_resolution(left, right, robot, found);
  const auto ticks = [&](const WheelSignal& s, double v) {
    const double counted = s.unit == WheelUnit::ticks ? v : v * robot.ticks_per_revolution;
    if (!(std::abs(counted) <= double(kMaxCsvInteger)))
      throw InputError(fmt::format("a wheel turns to {:g} ticks (must be within +-{})", counted, kMaxCsvInteger));
    return std::llround(counted);
  };
  const bool together = log.left.at == log.right.at;
  if (!together) found.push_back("the wheels were read at different times: the right one is taken between its samples");
  std::optional<WheelSignal> left_signal = log.left_command, right_signal = log.right_command;
  if (log.body_command && !left_signal) {
    std::tie(left_signal, right_signal) = wheel_commands(*log.body_command, robot.wheelbase_m, found);
  }
  run.has_commands = left_signal.has_value();
  Interpolator at_right(log.right.at, right);
  std::optional<Held> left_command, right_command;
  if (run.has_commands) {
    left_command.emplace(left_signal->at, left_signal->value);
    right_command.emplace(right_signal->at, right_signal->value);
  }
  for (std::size_t i = 0; i < log.left.at.size(); ++i) {
    const Nanoseconds t = log.left.at[i];
    if (t < log.right.at.front() || t > log.right.at.back()) continue;
    EncoderSample s{seconds(t - zero), ticks(log.left, left[i]), ticks(log.right, together ? right[i] : at_right.at(t)),
                    0, 0};
    if (run.has_commands) {
      s.left_command_radps = command_scale(left_signal->unit, robot.wheel_radius_m) * left_command->at(t);
      s.right_command_radps = command_scale(right_signal->unit, robot.wheel_radius_m) * right_command->at(t);
    }
    run.encoders.push_back(s);
  }
  if (run.encoders.size() < 2) throw InputError("the left and the right wheel were not read at the same time");
}

}  // namespace

RecordedRun whole_run(const Log& log, const ImportOptions& options, RecordedRobot& robot,
                      std::vector<std::string>& found) {
  const Nanoseconds moved = Nanoseconds(std::llround(options.truth_offset_s * 1e9));
  const Nanoseconds truth_from = log.truth.at.front() + moved, truth_to = log.truth.at.back() + moved;
  const Nanoseconds wheels_from = std::max(log.left.at.front(), log.right.at.front());
  const Nanoseconds wheels_to = std::min(log.left.at.back(), log.right.at.back());
  const Nanoseconds zero = wheels_from;
  RecordedRun run;
  run.id = "log";
  run.direction = "free";
  add_encoders(log, robot, zero, run, found);
  const Pose2 X_TB = options.X_BT ? inverse(*options.X_BT) : Pose2{};
  for (std::size_t i = 0; i < log.truth.at.size(); ++i) {
    run.truth.push_back({seconds(log.truth.at[i] + moved - zero), log.truth.pose[i] * X_TB});
  }
  if (options.truth_offset_s != 0) {
    found.push_back(fmt::format("clock: {:g} s were added to the truth's times, as given", options.truth_offset_s));
  }
  if (truth_from > wheels_to || wheels_from > truth_to) {
    const std::string best = offset_hint(run, robot, options.truth_offset_s);
    throw InputError(
        fmt::format("the wheels ({:.3f} s to {:.3f} s) and the truth ({:.3f} s to {:.3f} s) do not overlap in "
                    "time: {}",
                    seconds(wheels_from), seconds(wheels_to), seconds(truth_from), seconds(truth_to), best));
  }
  // Only what both saw, with a second at either end for clocks that differ a little.
  const double from = seconds(std::max(truth_from, wheels_from) - zero) - kEdge_s,
               to = seconds(std::min(truth_to, wheels_to) - zero) + kEdge_s;
  std::erase_if(run.encoders, [&](const EncoderSample& s) { return s.time_s < from || s.time_s > to; });
  std::erase_if(run.truth, [&](const TruthSample& s) { return s.time_s < from || s.time_s > to; });
  if (run.encoders.size() < 2 || run.truth.size() < 2) {
    throw InputError(
        fmt::format("the wheels were read {} times and the robot seen {} times in the time that both cover",
                    run.encoders.size(), run.truth.size()));
  }
  return run;
}

}  // namespace umbsim::exchange
