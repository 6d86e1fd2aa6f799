#include "recording/command_features.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace umbsim {
namespace {

double median(std::vector<double> x) {
  if (x.empty()) return 0;
  std::nth_element(x.begin(), x.begin() + std::ptrdiff_t(x.size() / 2), x.end());
  return x[x.size() / 2];
}

// When a growing signal first reaches a level, between samples.
double first_time(const std::vector<double>& t, const std::vector<double>& x, double level) {
  for (std::size_t i = 1; i < x.size(); ++i) {
    if (x[i] >= level) {
      const double part = x[i] > x[i - 1] ? std::clamp((level - x[i - 1]) / (x[i] - x[i - 1]), 0.0, 1.0) : 1;
      return t[i - 1] + part * (t[i] - t[i - 1]);
    }
  }
  return t.back();
}

// Plateau of one stretch's speed, and how fast it is reached between a fifth and four fifths of it, on a line between
// readings. Where none lies between them the set-point jumps.
struct Ramp {
  double speed = 0;
  double acceleration = 0;
  bool jumps = false;
};

Ramp ramp(const RecordedRun& run, const Stretch& s, const RecordedRobot& robot) {
  std::vector<double> t;
  std::vector<double> v;
  const double k = 2 * M_PI / robot.ticks_per_revolution;
  const double turn = s.kind == Stretch::Kind::turn ? 1 : 0;
  const std::size_t from = s.first > 5 ? s.first - 5 : 0;
  for (std::size_t i = from + 1; i <= s.last; ++i) {
    const EncoderSample& a = run.encoders[i - 1];
    const EncoderSample& b = run.encoders[i];
    const double dt = b.time_s - a.time_s;
    const double left = run.has_commands ? b.left_command_radps : k * double(b.left_ticks - a.left_ticks) / dt;
    const double right = run.has_commands ? b.right_command_radps : k * double(b.right_ticks - a.right_ticks) / dt;
    const double speed = turn ? (right - left) / robot.wheelbase_m : (right + left) / 2;
    t.push_back(b.time_s);
    v.push_back(std::abs(speed) * robot.wheel_radius_m);
  }
  if (v.size() < 4) return {};
  std::vector<double> sorted = v;
  std::sort(sorted.begin(), sorted.end());
  Ramp r;
  r.speed = sorted[sorted.size() * 3 / 4];
  const double low = 0.2 * r.speed, high = 0.8 * r.speed;
  const auto begun = std::find_if(v.begin(), v.end(), [&](double x) { return x >= low; });
  r.jumps = begun == v.end() || *begun >= high;
  const double dt = first_time(t, v, high) - first_time(t, v, low);
  r.acceleration = dt > 1e-4 ? 0.6 * r.speed / dt : 0;
  return r;
}

/// A reading that differs from the one before it.
struct Change {
  int periods = 0;   ///< since the change before it
  double ticks = 0;  ///< of the wheel that turned more
};

// Changes of counters that turn by two of their steps a period at least, with the changes next to them: slower ones
// stand still in between anyway.
std::vector<Change> changes_of(const RecordedRun& run, double width) {
  std::vector<Change> changes;
  std::size_t before = 0;  // how long counters stood still before the first change is not known
  for (std::size_t i = 1; i < run.encoders.size(); ++i) {
    const EncoderSample &now = run.encoders[i], &then = run.encoders[i - 1];
    const double ticks = std::max(std::abs(double(now.left_ticks - then.left_ticks)),
                                  std::abs(double(now.right_ticks - then.right_ticks)));
    if (ticks == 0) continue;
    if (before > 0) changes.push_back({int(i - before), ticks});
    before = i;
  }
  std::vector<Change> fast;
  for (std::size_t i = 1; i + 1 < changes.size(); ++i) {
    const Change &a = changes[i - 1], &b = changes[i], &c = changes[i + 1];
    const int periods = a.periods + b.periods + c.periods;
    if (a.ticks + b.ticks + c.ticks >= 2 * width * periods) fast.push_back(b);
  }
  return fast;
}

// Interval at which counters are read, over the period of the recording: their changes are as many periods apart as
// those in which the robot goes half of its way, or one more or less.
double sampling_ratio(const Recording& recording, double width) {
  std::vector<Change> all;
  double ticks = 0;
  for (const RecordedRun& run : recording.runs) {
    for (const Change& c : changes_of(run, width)) {
      all.push_back(c);
      ticks += c.ticks;
    }
  }
  if (all.empty()) return 1;
  std::sort(all.begin(), all.end(), [](const Change& a, const Change& b) { return a.periods < b.periods; });
  double half = ticks / 2;
  const auto usual = std::find_if(all.begin(), all.end() - 1, [&](const Change& c) { return (half -= c.ticks) <= 0; });
  double periods = 0;
  int changes = 0;
  for (const Change& c : all) {
    if (std::abs(c.periods - usual->periods) > 1) continue;
    periods += c.periods;
    changes += 1;
  }
  return changes > 20 ? periods / changes : 1;
}

}  // namespace

CommandFeatures measured_command_features(const Recording& recording,
                                          const std::vector<std::vector<Stretch>>& stretches, double count_step) {
  CommandFeatures command_features{};
  const RecordedPath& p = recording.path;
  std::vector<double> linear;
  std::vector<double> angular;
  std::vector<double> turning;
  int leg_jumps = 0, turn_jumps = 0;  // how many more starts jump than have a ramp
  for (std::size_t r = 0; r < recording.runs.size(); ++r) {
    if (!recording.runs[r].has_commands) continue;
    const bool in_place = recording.runs[r].turn.value_or(p.turn) == "in_place";
    for (const Stretch& s : stretches[r]) {
      if (s.kind == Stretch::Kind::still || s.end_s - s.start_s < 0.5) continue;
      const Ramp x = ramp(recording.runs[r], s, recording.robot);
      const bool turns = s.kind == Stretch::Kind::turn;
      if (turns && !in_place) continue;
      if (x.acceleration <= 0) continue;
      (turns ? angular : linear).push_back(x.acceleration);
      if (turns) turning.push_back(x.speed);
      (turns ? turn_jumps : leg_jumps) += x.jumps ? 1 : -1;
    }
  }
  const auto ratio = [](const std::vector<double>& measured, const std::optional<double>& declared) {
    return measured.size() >= 3 && declared && *declared > 0 ? std::log(median(measured) / *declared) : 0;
  };
  if (p.shape == "square") {
    // Of a driver without ramps nothing is measured of an acceleration.
    if (leg_jumps < 0 || turn_jumps < 0) {
      command_features[0] = ratio(linear, p.linear_acceleration_mps2);
      command_features[1] = ratio(angular, p.angular_acceleration_radps2);
    }
    command_features[2] = ratio(turning, p.angular_speed_radps);
  }
  command_features[3] = std::log(sampling_ratio(recording, count_step));
  if (command_features[3] < 0.04)
    command_features[3] = 0;  // counters that are read at every period stand still as good as never
  command_features[4] = -std::log(count_step);
  // What is hardly measured is as declared: ramps of one or two samples, a first or last step.
  for (double& h : command_features) {
    if (std::abs(h) < 0.02) h = 0;
  }
  return command_features;
}

}  // namespace umbsim
