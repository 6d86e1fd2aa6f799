#include "exchange/import/truth/clock_offset.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace umbsim::exchange {
namespace {

constexpr double kCell_s = 0.02;
constexpr double kMostShifts = 1e4;  // to either side, in one pass
constexpr double kGood = 0.8;        // correlation from which a shift is worth saying

/// An angle that grows, sampled every `cell_s` from `from_s` on, as what it turned in each cell.
struct Turns {
  double from_s = 0;
  std::vector<double> rad;
};

template <class Samples, class Angle>
Turns turns_of(const Samples& samples, const Angle& angle, double cell_s) {
  Turns t{samples.front().time_s, {}};
  std::size_t i = 0;
  double before = angle(samples.front());
  const double to_s = samples.back().time_s;
  for (double at = t.from_s + cell_s; at < to_s; at += cell_s) {
    while (i + 2 < samples.size() && samples[i + 1].time_s < at) ++i;
    const double share = (at - samples[i].time_s) / (samples[i + 1].time_s - samples[i].time_s);
    const double now = angle(samples[i]) + share * (angle(samples[i + 1]) - angle(samples[i]));
    t.rad.push_back(now - before);
    before = now;
  }
  return t;
}

// Correlation where the second series begins `shift` cells after the first; over all of the shorter one at least half.
double correlation(const std::vector<double>& a, const std::vector<double>& b, long shift) {
  double aa = 0, bb = 0, ab = 0;
  long common = 0;
  for (long i = std::max(0L, shift); i < long(a.size()) && i - shift < long(b.size()); ++i) {
    const double x = a[std::size_t(i)], y = b[std::size_t(i - shift)];
    aa += x * x;
    bb += y * y;
    ab += x * y;
    ++common;
  }
  if (common < long(std::min(a.size(), b.size())) / 2 || aa <= 0 || bb <= 0) return -1;
  return ab / std::sqrt(aa * bb);
}

std::optional<ClockOffset> best_shift(const RecordedRun& run, const RecordedRobot& robot, double about_s, double most_s,
                                      double cell_s) {
  const double k = 2 * M_PI * robot.wheel_radius_m / robot.ticks_per_revolution / robot.wheelbase_m;
  const Turns wheels = turns_of(
      run.encoders, [&](const EncoderSample& s) { return k * double(s.right_ticks - s.left_ticks); }, cell_s);
  const Turns truth = turns_of(
      run.truth, [](const TruthSample& s) { return s.X_WB.theta_rad; }, cell_s);
  const double apart_s = truth.from_s + about_s - wheels.from_s;
  const long middle = std::lround(apart_s / cell_s), reach = std::lround(most_s / cell_s);
  double best = 0;
  long at = 0;
  for (long shift = middle - reach; shift <= middle + reach; ++shift) {
    const double c = correlation(wheels.rad, truth.rad, shift);
    if (c > best) {
      best = c;
      at = shift;
    }
  }
  if (best <= 0) return std::nullopt;
  // A parabola through the best three.
  const double a = correlation(wheels.rad, truth.rad, at - 1), b = correlation(wheels.rad, truth.rad, at + 1);
  const double bend = a - 2 * best + b;
  const double part = bend < 0 ? std::clamp((a - b) / (2 * bend), -0.5, 0.5) : 0;
  return ClockOffset{(double(at) + part) * cell_s - (truth.from_s - wheels.from_s), best};
}

}  // namespace

std::optional<ClockOffset> clock_offset(const RecordedRun& run, const RecordedRobot& robot, double about_s,
                                        double most_s) {
  // Hours are looked through in larger cells first.
  const double cell_s = std::max(kCell_s, most_s / kMostShifts);
  const auto found = best_shift(run, robot, about_s, most_s, cell_s);
  if (!found || cell_s == kCell_s) return found;
  return best_shift(run, robot, found->add_s, 2 * cell_s, kCell_s);
}

std::string offset_hint(const RecordedRun& run, const RecordedRobot& robot, double already_s) {
  const double reach =
      (run.encoders.back().time_s - run.encoders.front().time_s + run.truth.back().time_s - run.truth.front().time_s) /
      2;
  const double about = (run.encoders.front().time_s + run.encoders.back().time_s) / 2 -
                       (run.truth.front().time_s + run.truth.back().time_s) / 2;
  const auto found = reach < 4000 ? clock_offset(run, robot, about, reach) : std::nullopt;
  if (!found || found->correlation < kGood) {
    return "two clocks? Give what must be added to the truth's times with --truth-offset SECONDS";
  }
  return fmt::format(
      "two clocks. Both turn together (correlation {:.2f}) if {:.3f} s are added to the truth's times: give "
      "--truth-offset {:.3f} if that is right",
      found->correlation, found->add_s + already_s, found->add_s + already_s);
}

}  // namespace umbsim::exchange
