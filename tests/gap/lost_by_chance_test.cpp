// Counts that get lost one by one make a robot scatter, and a robot that does not scatter lost none.
#include "gap/noise/lost_by_chance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "odometry/encoder.h"
#include "tests/gap/subject.h"

namespace umbsim::gap {
namespace {

using testing::campaign;
using testing::effect;
using testing::Subject;

constexpr double kWay_m = 1;
constexpr double kSpeed_radps = 4;

Recording rolled_once() {
  Recording recording;
  recording.robot.wheel_radius_m = 0.075;
  recording.robot.wheelbase_m = 0.34;
  recording.robot.ticks_per_revolution = 2000;
  RecordedRun run;
  run.truth = {{0, {}}, {kWay_m / recording.robot.wheel_radius_m / kSpeed_radps, {kWay_m, 0, 0}}};
  recording.runs = {run};
  return recording;
}

NominalReplay straight(const Recording& recording) {
  NominalReplay n;
  n.recording = &recording;
  n.truth = {{{}, {}}};
  n.wheels_m = {{{0, 0}, {kWay_m, kWay_m}}};
  return n;
}

// The encoder of the simulator, read many times over: its own scatter is the independent figure.
TEST(LostByChance, IsWhatEncodersScatter) {
  const Recording recording = rolled_once();
  const RecordedRobot& robot = recording.robot;
  const double shaft_rad = kWay_m / robot.wheel_radius_m;
  for (const auto& [p, of_speed] : {std::pair{0.002, 0.0}, std::pair{0.0, 0.001}}) {
    EncoderSpec spec;
    spec.ticks_per_revolution = robot.ticks_per_revolution;
    spec.left = {p, of_speed};
    constexpr int kEncoders = 20000;
    constexpr int kReadings = 20;
    double sum = 0;
    double squares = 0;
    for (int i = 0; i < kEncoders; ++i) {
      Encoder encoder(spec, spec.left, RandomStream(1, "lost", std::uint64_t(i)));
      double counted = 0;
      for (int k = 0; k <= kReadings; ++k) {
        const double angle_rad = shaft_rad * k / kReadings;
        counted = double(encoder.read(angle_rad / kSpeed_radps, angle_rad));
      }
      sum += counted;
      squares += counted * counted;
    }
    const double mean = sum / kEncoders;
    const double count_m = 2 * M_PI * robot.wheel_radius_m / robot.ticks_per_revolution;
    const double variance_m2 = (squares / kEncoders - mean * mean) * count_m * count_m;
    const Effect lost = effect("encoder_missed_counts", {{"left_probability", p}, {"probability_per_radps", of_speed}});
    const NoiseModel noise = lost_by_chance(straight(recording), {lost});
    // What grows with speed is lost on both wheels.
    const double wheels = of_speed > 0 ? 2 : 1;
    const double along = noise.along_m2_pm / wheels / (variance_m2 / 4 / kWay_m);
    const double heading = noise.heading_rad2_pm / wheels / (variance_m2 / std::pow(robot.wheelbase_m, 2) / kWay_m);
    std::cout << "p " << p << " + " << of_speed << " s: predicted over measured variance " << along << ", " << heading
              << "; heading " << 1000 * std::sqrt(noise.heading_rad2_pm) << " mrad over a metre\n";
    EXPECT_NEAR(along, 1, 0.05);
    EXPECT_NEAR(heading, 1, 0.05);
  }
}

TEST(LostByChance, NothingIsLostByOtherEffects) {
  const Recording recording = rolled_once();
  const NoiseModel noise =
      lost_by_chance(straight(recording), {effect("wheel_radius_difference", {{"relative", 0.01}})});
  EXPECT_EQ(noise.heading_rad2_pm, 0);
  EXPECT_EQ(noise.along_m2_pm, 0);
  EXPECT_EQ(lost_by_chance(straight(recording), {}).heading_rad2_pm, 0);
}

// Lost counts and unequal radii move the robot alike; the runs' scatter tells which it was.
TEST(LostByChance, UnequalRadiiAreNoLostCounts) {
  const Subject p(campaign({effect("wheel_radius_difference", {{"relative", 0.001}})}, 72));
  const Effect lost = effect("encoder_missed_counts", {{"right_probability", 0.001}});
  std::cout << "log likelihood of the little scatter, were a thousandth of the counts lost: "
            << p.model.log_chance({lost}) << "\n";
  EXPECT_LT(p.model.log_chance({lost}), -Thresholds{}.detect);
  EXPECT_EQ(p.diagnosed().causes.front().name, "wheel_radius_difference");
  const Diagnosis without = p.diagnosed({"wheel_radius_difference"});
  std::cout << "without the radii: " << without.causes.front().name << "\n";
  EXPECT_EQ(without.causes.front().name.find("encoder_missed_counts"), std::string::npos);
}

// Many lost counts scatter over several readings each: from one reading to the next they seem to scatter less.
TEST(LostByChance, ManyLostCountsScatterAsTheyMust) {
  for (const double probability : {0.004, 0.006}) {
    const Effect lost =
        effect("encoder_missed_counts", {{"left_probability", probability}, {"right_probability", probability}});
    const Subject p(campaign({lost}, 74));
    const double chance = p.model.log_chance({lost});
    std::cout << "log likelihood of the scatter, were " << probability << " lost: " << chance << "\n";
    EXPECT_GT(chance, -4);
  }
}

TEST(LostByChance, LostCountsScatterAsTheyMust) {
  const Effect lost = effect("encoder_missed_counts", {{"right_probability", 0.001}});
  const Subject p(campaign({lost}, 73));
  std::cout << "log likelihood of the scatter of lost counts: " << p.model.log_chance({lost}) << "\n";
  EXPECT_GT(p.model.log_chance({lost}), -2);
  EXPECT_EQ(p.diagnosed().causes.front().name, "encoder_missed_counts");
}

}  // namespace
}  // namespace umbsim::gap
