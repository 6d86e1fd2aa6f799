#include "experiment/drive/check_loop.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "experiment/drive/commanded_course.h"

namespace umbsim {
namespace {

constexpr double kFastestLoop_s = 1e-4;  // encoders.rate_hz at most

// Rounded towards where the loop works, so that the value that is printed does.
constexpr double kFound = 0.01;  // a limit that is a round number is found to a millionth of it
double rounded_up(double value) { return std::ceil(value * 100 - kFound) / 100; }
double rounded_down(double value) { return std::floor(value * 1000 + kFound) / 1000; }

// One of the keys that make the loop slow, and what it may be at most, or at least, the others as they are.
struct SlowPart {
  const char* key;
  double LoopTiming::*member;
  double good;  // with which it adds nothing
};
constexpr SlowPart kParts[] = {{"encoders.rate_hz", &LoopTiming::period_s, kFastestLoop_s},
                               {"effects.encoder_sampling.interval_s", &LoopTiming::sampling_s, 0},
                               {"effects.encoder_latency.seconds", &LoopTiming::latency_s, 0},
                               {"effects.motor_response.lag_s", &LoopTiming::lag_s, 0},
                               {"effects.motor_response.droop_radps_per_nm", &LoopTiming::droop_s, 0}};

// That each motor moves as the robot speeds up.
double inertia_kgm2(const Rig& rig) {
  const double radius_m = std::max(rig.robot.wheels[0].radius_m, rig.robot.wheels[1].radius_m);
  return rig.robot.total_mass_kg() / 2 * radius_m * radius_m;
}

// A time of the loop as its key says it.
double said(const SlowPart& part, double time_s, const Rig& rig) {
  if (part.member == &LoopTiming::period_s) return 1 / time_s;
  return part.member == &LoopTiming::droop_s ? time_s / inertia_kgm2(rig) : time_s;
}

// What each part may be; empty if no part alone is to blame.
std::vector<std::string> bounds_of(const LoopTiming& timing, const Rig& rig, double speed_mps) {
  std::vector<std::string> bounds;
  for (const SlowPart& part : kParts) {
    const double value = timing.*part.member;
    if (value <= part.good) continue;
    const auto most = limit(timing, part.member, part.good, speed_mps);
    if (!most) continue;
    const bool rate = part.member == &LoopTiming::period_s;
    const double bound = said(part, *most, rig);
    bounds.push_back(fmt::format("{} = {:g} (must be {} {:g})", part.key, said(part, value, rig),
                                 rate ? ">=" : "<=", rate ? rounded_up(bound) : rounded_down(bound)));
  }
  return bounds;
}

std::string values_of(const LoopTiming& timing, const Rig& rig) {
  std::vector<std::string> values;
  for (const SlowPart& part : kParts) {
    const double value = timing.*part.member;
    if (value <= part.good) continue;
    values.push_back(fmt::format("{} = {:g}", part.key, said(part, value, rig)));
  }
  return fmt::format("{}: too slow together", fmt::join(values, ", "));
}

}  // namespace

LoopTiming loop_timing(const Scenario& s, const Rig& rig) {
  LoopTiming timing;
  timing.period_s = 1 / rig.encoders.rate_hz;
  timing.sampling_s = rig.encoders.sampling_interval_s;
  timing.latency_s = rig.encoders.latency_s;
  for (const Motor& m : rig.drivetrain.motor) {
    timing.lag_s = std::max(timing.lag_s, m.lag_s);
    timing.droop_s = std::max(timing.droop_s, m.droop_radps_per_nm * inertia_kgm2(rig));
  }
  timing.step_s = s.physics.step_s;
  return timing;
}

void check_control_loop(const Scenario& s, const Rig& rig) {
  const LoopTiming timing = loop_timing(s, rig);
  double speed_mps = 0;
  const Plan plan(commanded(s.course, rig.commanded_motion), Direction::ccw);
  for (const Segment& segment : plan.segments()) {
    if (segment.length_m > 0) speed_mps = std::max(speed_mps, segment.speed);
  }
  if (settles(timing, speed_mps) && settles(timing, 0)) return;
  const std::vector<std::string> bounds = bounds_of(timing, rig, settles(timing, speed_mps) ? 0 : speed_mps);
  throw InputError(fmt::format(
      "{}: {}: the control loop that keeps the robot on its course, from the encoders' counts to the motors, runs at "
      "{:g} Hz and is too slow at {:g} m/s: its corrections come so late that they add to the error",
      s.file, bounds.empty() ? values_of(timing, rig) : fmt::format("{}", fmt::join(bounds, " or ")),
      1 / timing.period_s, speed_mps));
}

}  // namespace umbsim
