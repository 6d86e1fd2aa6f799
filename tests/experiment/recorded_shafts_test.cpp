// Shafts between counts and commands, against a motor whose angle is integrated in fine steps.
#include "experiment/replay/recorded_shafts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

namespace umbsim {
namespace {

constexpr double kReading_s = 0.025;
constexpr int kStepsPerReading = 2;
constexpr int kLegsDriven = 6;

// Up to 3 rad/s within 0.6 s, on for 6 s, down again, at rest for a second, and the same backwards.
double asked_radps(double t_s) {
  const double leg_s = std::fmod(t_s, 8.2);
  const double sign = int(t_s / 8.2) % 2 == 0 ? 1 : -1;
  return sign * 3 * std::clamp(std::min(leg_s / 0.6, (7.2 - leg_s) / 0.6), 0.0, 1.0);
}

struct DrivenShaft {
  RecordedRun run;
  std::vector<double> angle;  // true, at the samples
};

// `integral_s` 0: without an integral part, a first-order lag.
DrivenShaft driven_shaft(double ticks_per_revolution, double lag_s, double integral_s) {
  constexpr int kFine = 500;
  DrivenShaft d;
  d.run.has_commands = true;
  d.run.truth = {{0, {}}};
  double angle = 0.123, speed = 0, owed = 0;
  for (int i = 0; i * kReading_s < kLegsDriven * 8.2; ++i) {
    const double from = asked_radps((i - 1) * kReading_s), to = asked_radps(i * kReading_s);
    for (int k = 0; i > 0 && k < kFine; ++k) {
      const double step_s = kReading_s / kFine;
      const double behind = from + (to - from) * (k + 0.5) / kFine - speed;
      owed += behind * step_s;
      speed += step_s / lag_s * (behind + (integral_s > 0 ? owed / integral_s : 0));
      angle += speed * step_s;
    }
    const auto ticks = std::llround(angle / (2 * M_PI) * ticks_per_revolution);
    d.run.encoders.push_back({i * kReading_s, ticks, ticks, to, to});
    d.angle.push_back(angle);
  }
  return d;
}

// How far the replayed shaft strays from the true one, in counts: its root mean square, and on the mean over the same
// part of all legs, which does not average out over many legs.
struct Astray {
  double all = 0, systematic = 0;
};

Astray astray(const DrivenShaft& d, double ticks_per_revolution) {
  RecordedRobot robot;
  robot.wheel_radius_m = 0.075;
  robot.wheelbase_m = 0.34;
  robot.ticks_per_revolution = ticks_per_revolution;
  EncoderSpec spec;
  spec.ticks_per_revolution = ticks_per_revolution;
  const std::vector<EncoderSample>& s = d.run.encoders;
  const std::vector<double> speed =
      shaft_speeds(d.run, spec, {}, true, measured_lag(d.run, robot, kStepsPerReading), kStepsPerReading, 1);
  const double count_rad = 2 * M_PI / ticks_per_revolution;
  std::vector<double> off(s.size());
  double turned = 0, mean = 0;
  for (std::size_t i = 1; i < s.size(); ++i) {
    // As a simulator of two steps a period turns its shafts: each step at the speed of its end.
    turned += kReading_s * (0.25 * speed[i - 1] + 0.75 * speed[i]);
    off[i] = (turned - (d.angle[i] - d.angle[0])) / count_rad;
    mean += off[i] / double(s.size());
  }
  Astray a;
  const std::size_t leg = std::size_t(std::lround(8.2 / kReading_s));
  std::vector<double> of_part(leg);
  for (std::size_t i = 0; i < s.size(); ++i) {
    const double sign = i / leg % 2 == 0 ? 1 : -1;
    a.all += std::pow(off[i] - mean, 2) / double(s.size());
    of_part[i % leg] += sign * (off[i] - mean) / kLegsDriven;
  }
  for (const double part : of_part) a.systematic += part * part / double(leg);
  return {std::sqrt(a.all), std::sqrt(a.systematic)};
}

class RecordedShafts : public ::testing::TestWithParam<double> {};

TEST_P(RecordedShafts, MotorsWithAnIntegralPartAreFollowedWithinACount) {
  const double ticks = GetParam();
  const Astray integral = astray(driven_shaft(ticks, 0.01, 0.15), ticks),
               lag = astray(driven_shaft(ticks, 0.05, 0), ticks);
  std::cout << ticks << " counts a revolution: astray by " << integral.all << " counts, the same on every leg by "
            << integral.systematic << "; of a lag by " << lag.all << " and " << lag.systematic << "\n";
  EXPECT_LT(integral.all, 0.25);
  EXPECT_LT(integral.systematic, 0.2);
  EXPECT_LT(lag.all, 0.12);
  EXPECT_LT(lag.systematic, 0.09);
}

INSTANTIATE_TEST_SUITE_P(Counts, RecordedShafts, ::testing::Values(360, 1000, 2000, 8000));

}  // namespace
}  // namespace umbsim
