#include "experiment/replay/recorded_shafts.h"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>

#include "recording/coarse_counts.h"
#include "recording/counts_behind.h"
#include "recording/encoder_clock.h"

namespace umbsim {
namespace {

// Angles of a shaft that the counts stand for, in radians, smoothed over neighbours so that the counts' staircase does
// not shake the robot. Binomial weights: no drift, and straight ramps stay as they are.
std::vector<double> smoothed(std::vector<double> angle) {
  const std::size_t n = angle.size();
  for (int pass = 0; pass < 2; ++pass) {
    std::vector<double> next = angle;
    for (std::size_t i = 1; i + 1 < n; ++i) next[i] = (angle[i - 1] + 2 * angle[i] + angle[i + 1]) / 4;
    angle = std::move(next);
  }
  return angle;
}

// Counts that were latched only every so often stand still in between: the moments of change are joined by lines. Where
// nothing changes for longer the wheel stands, until one interval before the next change.
void join_latches(std::vector<double>& counts, const std::vector<EncoderSample>& samples, double interval_s) {
  if (interval_s <= 0) return;
  std::size_t from = 0;
  const std::vector<double> latched = counts;
  for (std::size_t i = 1; i < counts.size(); ++i) {
    if (latched[i] == latched[i - 1]) continue;
    while (from + 1 < i && samples[i].time_s - samples[from + 1].time_s > interval_s - 1e-9) ++from;
    for (std::size_t j = from + 1; j < i; ++j) {
      counts[j] = latched[from] + (latched[i] - latched[from]) * double(j - from) / double(i - from);
    }
    from = i;
  }
}

// The same speeds half a time step later, so that the staircase turns the shaft as far as it did.
std::vector<double> half_a_step_later(const std::vector<double>& speed, int steps) {
  std::vector<double> later = speed;
  for (std::size_t i = 1; i < speed.size(); ++i) later[i] += (speed[i - 1] - speed[i]) / (2.0 * steps);
  return later;
}

// Commands that ramp from one sample to the next, late.
std::vector<double> late_commands(const std::vector<EncoderSample>& s, double EncoderSample::*command, double dead_s) {
  std::vector<double> late(s.size());
  std::size_t k = 0;
  for (std::size_t i = 0; i < s.size(); ++i) {
    const double at_s = s[i].time_s - dead_s;
    while (k + 2 < s.size() && s[k + 1].time_s < at_s) ++k;
    const double on = std::clamp((at_s - s[k].time_s) / (s[k + 1].time_s - s[k].time_s), 0.0, 1.0);
    late[i] = s[k].*command + on * (s[k + 1].*command - s[k].*command);
  }
  return late;
}

// A wheel's speed at the samples if it follows the commands so late.
std::vector<double> obeyed(const std::vector<EncoderSample>& s, double EncoderSample::*command, const CommandLag& lag) {
  const std::vector<double> asked = late_commands(s, command, lag.dead_s);
  std::vector<double> speed(s.size());
  speed[0] = asked[0];
  for (std::size_t i = 1; i < s.size(); ++i) {
    const double dt = s[i].time_s - s[i - 1].time_s;
    const double behind = (asked[i] - asked[i - 1]) / dt * lag.slow_s;
    const double fading = lag.slow_s > 0 ? std::exp(-dt / lag.slow_s) : 0;
    speed[i] = asked[i] - behind + (speed[i - 1] - asked[i - 1] + behind) * fading;
  }
  return speed;
}

// Mean over neighbours within half a window, fewer at the ends.
std::vector<double> averaged(const std::vector<double>& x, std::size_t half) {
  std::vector<double> sum(x.size() + 1);
  for (std::size_t i = 0; i < x.size(); ++i) sum[i + 1] = sum[i] + x[i];
  std::vector<double> mean(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    const std::size_t h = std::min({half, i, x.size() - 1 - i});
    mean[i] = (sum[i + h + 1] - sum[i - h]) / double(2 * h + 1);
  }
  return mean;
}

// Speeds at the samples whose ramps in between turn the shaft as far as it did.
std::vector<double> speeds(const std::vector<double>& angle, const std::vector<EncoderSample>& s) {
  std::vector<double> speed(angle.size());
  for (std::size_t i = 1; i + 1 < angle.size(); ++i) {
    speed[i] = (angle[i + 1] - angle[i - 1]) / (s[i + 1].time_s - s[i - 1].time_s);
  }
  return speed;
}

// Speeds at the samples, of which all were read late. What had turned before the first reading is not known.
std::vector<double> sooner(const std::vector<double>& speed, const std::vector<EncoderSample>& s, double late_s) {
  if (late_s == 0) return speed;
  std::vector<double> then;
  EncoderClock clock(s);
  for (const EncoderSample& sample : s) {
    const auto m = clock.at(sample.time_s + late_s);
    then.push_back(m.between(speed[m.before], speed[m.before + 1]));
  }
  return then;
}

double latch_age_s(const EncoderSpec& spec, const std::vector<EncoderSample>& s) {
  return mean_latch_age_s(spec.sampling_interval_s, (s.back().time_s - s.front().time_s) / double(s.size() - 1));
}

// Least squares of how much further a shaft turns than commanded, per commanded angle, and the squares that it leaves.
struct Gain {
  double per_rad = 0, left_rad2 = 0;
};

Gain gain_of(const std::vector<double>& ahead, const std::vector<double>& turned) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  for (std::size_t i = 0; i < ahead.size(); ++i) {
    n += 1;
    x += turned[i];
    y += ahead[i];
    xx += turned[i] * turned[i];
    xy += turned[i] * ahead[i];
    yy += ahead[i] * ahead[i];
  }
  const double spread = n * xx - x * x, shared = n * xy - x * y;
  const double gain = spread > 0 ? shared / spread : 0;
  return {gain, yy - y * y / n - gain * shared / n};
}

struct Bounds {
  double low = 0;
  double high = 0;
  double middle() const { return (low + high) / 2; }
};

// Bounds of a slow drift that is within `half` of every `ahead`, from the samples up to each.
std::vector<Bounds> bounded(const std::vector<double>& ahead, const std::vector<double>& drift, double half) {
  std::vector<Bounds> bounds;
  Bounds b{ahead.front() - half, ahead.front() + half};
  for (std::size_t i = 0; i < ahead.size(); ++i) {
    b.low = std::min(std::max(b.low - drift[i], ahead[i] - half), ahead[i] + half);
    b.high = std::max(std::min(b.high + drift[i], ahead[i] + half), ahead[i] - half);
    bounds.push_back(b);
  }
  return bounds;
}

// How far a shaft is ahead of its commands, where counts say so in steps of twice `half` only. The moments of the steps
// tell more than the counts in between: at rest a count may be half a step off for long.
std::vector<Bounds> between_steps(std::vector<double> ahead, const std::vector<double>& turned, double half) {
  constexpr double kDrift = 1e-3;  // of commanded rotation, beyond a constant gain
  const double gain = gain_of(ahead, turned).per_rad;
  std::vector<double> drift(ahead.size());
  for (std::size_t i = 0; i < ahead.size(); ++i) ahead[i] -= gain * turned[i];
  for (std::size_t i = 1; i < ahead.size(); ++i) drift[i] = kDrift * std::abs(turned[i] - turned[i - 1]);
  const std::vector<Bounds> past = bounded(ahead, drift, half);
  std::vector<double> reversed(ahead.rbegin(), ahead.rend());
  std::vector<double> reversed_drift(ahead.size());
  for (std::size_t i = 1; i < drift.size(); ++i) reversed_drift[i] = drift[drift.size() - i];
  const std::vector<Bounds> future = bounded(reversed, reversed_drift, half);
  std::vector<Bounds> both;
  for (std::size_t i = 0; i < ahead.size(); ++i) {
    const Bounds& f = future[ahead.size() - 1 - i];
    const auto [low, high] = std::minmax(std::max(past[i].low, f.low), std::min(past[i].high, f.high));
    both.push_back({low + gain * turned[i], high + gain * turned[i]});
  }
  return both;
}

// The middles of bounds, each averaged over as many neighbours as agree with fewer of them to what those are known to
// (Lepski 1991): the steps of counts do not shake the robot, and motors that leave their commands for a tenth of a
// second are followed.
std::vector<double> averaged_within(const std::vector<Bounds>& bounds) {
  std::vector<double> result;
  for (const Bounds& b : bounds) result.push_back(b.middle());
  const std::vector<double> middle = result;
  std::vector<bool> wider(bounds.size(), true);
  std::size_t averaged_over = 1;
  for (const std::size_t half : {1, 2, 3, 5}) {  // samples, twice
    const std::vector<double> mean = averaged(averaged(middle, half), half);
    for (std::size_t i = 0; i < bounds.size(); ++i) {
      const double sd = (bounds[i].high - bounds[i].low) / std::sqrt(12.0 * double(averaged_over));
      wider[i] = wider[i] && std::abs(mean[i] - result[i]) <= sd;
      if (wider[i]) result[i] = mean[i];
    }
    averaged_over = 2 * half + 1;
  }
  return result;
}

}  // namespace

// A time step moves with the speed at its end, so that with `steps` a period the ramp is a staircase that runs ahead by
// half a step.
std::vector<double> turned_by(const std::vector<EncoderSample>& s, const std::vector<double>& radps, int steps) {
  const double before = (steps - 1) / (2.0 * steps);
  std::vector<double> angle(s.size());
  for (std::size_t i = 1; i < s.size(); ++i) {
    angle[i] = angle[i - 1] + (before * radps[i - 1] + (1 - before) * radps[i]) * (s[i].time_s - s[i - 1].time_s);
  }
  return angle;
}

CommandLag measured_lag(const RecordedRun& run, const RecordedRobot& robot, int steps) {
  if (!run.has_commands) return {};
  constexpr double EncoderSample::*kCommand[] = {&EncoderSample::left_command_radps,
                                                 &EncoderSample::right_command_radps};
  constexpr std::int64_t EncoderSample::*kTicks[] = {&EncoderSample::left_ticks, &EncoderSample::right_ticks};
  const std::vector<HeadingOverTime> heading = heading_over_time(run, robot);
  const double step_rad = 2 * M_PI / robot.ticks_per_revolution;
  std::vector<double> counted[2];
  double all_s = 0;
  for (int w = 0; w < 2; ++w) {
    for (const EncoderSample& s : run.encoders) counted[w].push_back(step_rad * double(s.*kTicks[w]));
    const std::vector<double> speed = obeyed(run.encoders, kCommand[w], {});
    all_s += 0.5 * counts_behind(speed, turned_by(run.encoders, speed, steps), counted[w], heading, step_rad).lag_s;
  }
  if (all_s <= 0) return {0, all_s};
  const auto left_rad2 = [&](double dead_s) {
    double sum = 0;
    for (int w = 0; w < 2; ++w) {
      const std::vector<double> speed = obeyed(run.encoders, kCommand[w], {dead_s, all_s - dead_s});
      const std::vector<double> turned = turned_by(run.encoders, speed, steps);
      std::vector<double> ahead = counted[w];
      for (std::size_t i = 0; i < ahead.size(); ++i) ahead[i] -= turned[i];
      sum += gain_of(ahead, turned).left_rad2;
    }
    return sum;
  };
  constexpr int kBits = 8;
  const double dead_s = boost::math::tools::brent_find_minima(left_rad2, 0.0, all_s, kBits).first;
  return {dead_s, all_s - dead_s};
}

std::vector<double> shaft_speeds(const RecordedRun& run, const EncoderSpec& spec, const EncoderFaults& faults,
                                 bool left, const CommandLag& lag, int steps, double count_step) {
  const auto ticks = left ? &EncoderSample::left_ticks : &EncoderSample::right_ticks;
  const std::vector<EncoderSample>& s = run.encoders;
  const double k = 2 * M_PI / spec.ticks_per_revolution;
  std::vector<double> counts(s.size());
  for (std::size_t i = 0; i < s.size(); ++i) counts[i] = double(s[i].*ticks);
  if (count_step > 1) {
    counts = steps_counted(s, ticks, count_step);
    for (double& c : counts) c *= count_step;
  }
  join_latches(counts, s, spec.sampling_interval_s);
  std::vector<double> angle(s.size());
  for (std::size_t i = 1; i < s.size(); ++i) {
    const double counted = k * (counts[i] - counts[i - 1]);
    const double speed = std::abs(counted) / (s[i].time_s - s[i - 1].time_s);
    const double missed = std::min(0.9, faults.missed_probability + faults.missed_probability_per_radps * speed);
    angle[i] = angle[i - 1] + counted / (1 - missed);
  }
  if (!run.has_commands) {
    return sooner(half_a_step_later(speeds(smoothed(std::move(angle)), s), steps), s, spec.latency_s);
  }
  // The commands say finely what the counts say coarsely: the motor follows them, and drifts from them slowly.
  const auto command = left ? &EncoderSample::left_command_radps : &EncoderSample::right_command_radps;
  const double latched_s = latch_age_s(spec, s);
  const double late_s = std::max(0.0, lag.all_s() - latched_s);
  const double dead_s = std::clamp(lag.dead_s - latched_s, 0.0, late_s);
  const std::vector<double> asked = obeyed(s, command, {dead_s, late_s - dead_s});
  const std::vector<double> turned = turned_by(s, asked, steps);
  for (std::size_t i = 0; i < s.size(); ++i) angle[i] -= turned[i];
  angle = averaged_within(between_steps(std::move(angle), turned, k * count_step / 2));
  std::vector<double> speed = half_a_step_later(speeds(angle, s), steps);
  for (std::size_t i = 0; i < s.size(); ++i) speed[i] += asked[i];
  return sooner(speed, s, spec.latency_s);
}

std::vector<std::array<double, 2>> arrived(const std::vector<std::array<double, 2>>& shaft,
                                           const std::vector<EncoderSample>& s, const EncoderSpec& spec,
                                           double step_rad) {
  std::vector<std::array<double, 2>> counted = shaft;
  for (std::size_t w = 0; w < 2; ++w) {
    const EncoderFaults& faults = w == 0 ? spec.left : spec.right;
    for (std::size_t i = 1; i < s.size(); ++i) {
      const double turned = shaft[i][w] - shaft[i - 1][w];
      const double speed = std::abs(turned) / (s[i].time_s - s[i - 1].time_s);
      const double missed = std::min(0.9, faults.missed_probability + faults.missed_probability_per_radps * speed);
      counted[i][w] = counted[i - 1][w] + turned * (1 - missed);
    }
    if (step_rad == 0) continue;
    for (std::array<double, 2>& angle : counted) angle[w] = std::round(angle[w] / step_rad) * step_rad;
  }
  const double late_s = spec.latency_s + latch_age_s(spec, s);
  if (late_s == 0) return counted;
  std::vector<std::array<double, 2>> result = counted;
  EncoderClock clock(s);
  for (std::size_t i = 0; i < s.size(); ++i) {
    const auto m = clock.at(s[i].time_s - late_s);
    for (std::size_t w = 0; w < 2; ++w) result[i][w] = m.between(counted[m.before][w], counted[m.before + 1][w]);
  }
  return result;
}

}  // namespace umbsim
