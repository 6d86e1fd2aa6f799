#include "umbmark/control_loop.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace umbsim {
namespace {

constexpr double kClockSlack_s = 1e-9;  // times are sums of periods
constexpr int kSpans = 150;             // of the slowest part of the loop, over which an error must shrink
constexpr double kLeastSpan_s = 0.2;
constexpr double kGone = 1e-150;

// Of every period the one whose counts its readings show; -1: none has arrived yet.
std::vector<int> readings(const LoopTiming& t, int periods) {
  const int late = int(std::ceil(t.latency_s / t.period_s - kClockSlack_s));
  std::vector<int> latched(std::size_t(periods), 0), seen(std::size_t(periods), -1);
  double next_s = 0;
  for (int k = 0, last = 0; k < periods; ++k) {
    const double time_s = k * t.period_s;
    if (time_s + kClockSlack_s >= next_s) {
      last = k;
      next_s = t.sampling_s > 0 ? next_s + t.sampling_s : time_s;
    }
    latched[std::size_t(k)] = last;
    if (k >= late) seen[std::size_t(k)] = latched[std::size_t(k - late)];
  }
  return seen;
}

// Errors of a robot that follows a line, and how it turns.
struct OffCourse {
  double heading_rad = 1;
  double across_m = 0;
  double turning_radps = 0;  // of the motors
};

// A period of the motors: a ramp of the set-point, and the lag.
void turn(OffCourse& off, const LoopTiming& t, double speed_mps, double from_radps, double to_radps) {
  const int steps = std::max(1, int(std::ceil(t.period_s / t.step_s - kClockSlack_s)));
  const double step_s = t.period_s / steps;
  const double lag_s = t.lag_s + t.droop_s, follow = lag_s > 0 ? 1 - std::exp(-step_s / lag_s) : 1;
  for (int i = 1; i <= steps; ++i) {
    const double wanted = from_radps + (to_radps - from_radps) * i / steps;
    off.turning_radps += follow * (wanted - off.turning_radps);
    off.across_m += speed_mps * step_s * (off.heading_rad + off.turning_radps * step_s / 2);
    off.heading_rad += off.turning_radps * step_s;
  }
}

}  // namespace

double across_gain(double speed_mps) {
  return kDriver.across * kDriver.across * speed_mps /
         std::max(speed_mps * speed_mps, kDriver.slow_mps * kDriver.slow_mps);
}

// The loop is linear for small errors: from any error it goes on growing or shrinking at the rate of its slowest mode.
// Along the path it is the same loop as for the heading with a smaller gain, and settles where that one does.
bool settles(const LoopTiming& t, double speed_mps) {
  const double span_s = std::max({t.period_s, t.sampling_s, t.latency_s, t.lag_s + t.droop_s, kLeastSpan_s});
  const int third = int(std::ceil(kSpans / 3.0 * span_s / t.period_s));
  const std::vector<int> seen = readings(t, 3 * third);
  std::vector<OffCourse> past;
  OffCourse off;
  double command_radps = 0, middle = 0, last = 0;
  for (int k = 0; k < 3 * third; ++k) {
    past.push_back(off);
    const int i = seen[std::size_t(k)];
    const OffCourse known = i < 0 ? OffCourse{0, 0, 0} : past[std::size_t(i)];
    const double before_radps = command_radps;
    command_radps = -kDriver.heading * known.heading_rad - across_gain(speed_mps) * known.across_m;
    turn(off, t, speed_mps, before_radps, command_radps);
    const double size =
        std::abs(off.heading_rad) + std::abs(off.across_m) * kDriver.heading / std::max(speed_mps, 1e-9);
    if (!std::isfinite(size)) return false;
    if (k >= 2 * third)
      last = std::max(last, size);
    else if (k >= third)
      middle = std::max(middle, size);
  }
  return last < middle || middle < kGone;
}

double overshoot(const LoopTiming& t, double gain, double ramp_s) {
  const int periods = std::max(1, int(std::ceil(ramp_s / t.period_s)));
  const std::vector<int> seen = readings(t, periods);
  const auto course = [](double time_s) { return time_s * time_s / 2; };
  std::vector<double> past;
  OffCourse robot{0, 0, 0};  // how far it has come stands for its heading
  double command = 0, most = 1;
  for (int k = 0; k < periods; ++k) {
    past.push_back(robot.heading_rad);
    const int i = seen[std::size_t(k)];
    const double time_s = k * t.period_s, before = command, speed = robot.turning_radps;
    command = (course(time_s + t.period_s) - course(time_s)) / t.period_s +
              gain * (course(time_s) - (i < 0 ? 0 : past[std::size_t(i)]));
    turn(robot, t, 0, before, command);
    most = std::max(most, (robot.turning_radps - speed) / t.period_s);
  }
  return most;
}

std::optional<double> limit(LoopTiming timing, double LoopTiming::*member, double good, double speed_mps) {
  double bad = timing.*member;
  timing.*member = good;
  if (!settles(timing, speed_mps)) return std::nullopt;
  while (std::abs(bad - good) > 1e-6 * std::max(std::abs(bad), std::abs(good))) {
    timing.*member = (good + bad) / 2;
    (settles(timing, speed_mps) ? good : bad) = timing.*member;
  }
  return good;
}

}  // namespace umbsim
