// How far numbers are off in other engines: learned errors against closed forms, and what a score says of numbers.
#include "bench/worlds/score/numbers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "core/random.h"

namespace umbsim::worlds {
namespace {

std::vector<FoundNumber> drawn(int count, double error, double noise_sd) {
  RandomStream random(3, "numbers");
  std::vector<FoundNumber> numbers;
  for (int i = 0; i < count; ++i)
    numbers.push_back({"push", "mujoco", Measure::size, std::hypot(error, noise_sd) * random.normal(), noise_sd});
  return numbers;
}

TEST(NumberErrors, AreFoundBesideNoise) {
  for (const double error : {0.05, 0.3}) {
    const double found = likeliest_error(drawn(4000, error, 0.1), Measure::size);
    std::cout << "error " << error << " beside noise of 0.1: " << found << "\n";
    EXPECT_NEAR(found, error, 0.25 * error);
  }
}

TEST(NumberErrors, WithoutNumbersAreWhatIsUsual) {
  EXPECT_NEAR(likeliest_error({}, Measure::size), 0.1, 0.005);
  EXPECT_NEAR(likeliest_error({}, Measure::place), 0.02, 0.001);
}

TEST(NumberErrors, MakeIntervalsThatHold95Percent) {
  const std::vector<FoundNumber> numbers = drawn(4000, 0.3, 0.1);
  EXPECT_NEAR(held(numbers, 0.3) / 4000.0, 0.95, 0.011);  // three standard deviations of the share
  EXPECT_LT(held(numbers, 0), 2400);
}

/// A world in which one effect was named, with one number of it.
WorldVerdict named(const std::string& effect, const std::string& parameter, double truth,
                   const ParameterEstimate& estimate) {
  WorldVerdict w;
  w.kind = "single";
  w.groups["engine"] = "planar";
  w.verdict.answer.effects[effect].parameters[parameter] = truth;
  Cause cause;
  cause.effects = {effect};
  cause.parameters[effect][parameter] = estimate;
  w.verdict.diagnosis.causes = {cause};
  return w;
}

TEST(FoundNumbers, AreOffInTheirMeasure) {
  WorldScore score;
  score.verdicts = {named("bump", "height_m", 0.006, {0.009, 0.008, 0.010}),
                    named("encoder_latency", "seconds", 0.10, {0.11, 0.09, 0.13}),
                    named("wheel_lift", "x_m", 1, {0.97, 0.8, 1.2}),
                    named("wheel_eccentricity", "left_phase_rad", 3.1, {-3.1, -3.2, -3.0}),
                    named("floor_slope", "slope_rad", 0.02, {0, 0, 0}),  // not found
                    named("wheelbase", "relative", 0.01, {-0.01, -0.02, 0}),
                    named("bump", "x_m", 1, {2, 1.9, 2.1})};  // anywhere along the cable
  const std::vector<FoundNumber> numbers = found_numbers(score);
  ASSERT_EQ(numbers.size(), 4u);
  EXPECT_EQ(numbers[0].measure, Measure::size);
  EXPECT_NEAR(numbers[0].off, std::log(1.5), 1e-12);
  EXPECT_EQ(numbers[1].measure, Measure::time);
  EXPECT_NEAR(numbers[1].off, 0.01, 1e-12);
  EXPECT_EQ(numbers[2].measure, Measure::place);
  EXPECT_NEAR(numbers[2].off, -0.03, 1e-12);
  EXPECT_NEAR(std::pow(numbers[2].noise_sd, 2) + std::pow(error_in_use("wheel_lift", Measure::place), 2),
              std::pow(0.4 / 3.92, 2), 1e-12);
  EXPECT_EQ(numbers[3].measure, Measure::angle);
  EXPECT_NEAR(numbers[3].off, 2 * M_PI - 6.2, 1e-12);
}

TEST(FoundNumbers, AreOfSingleEffectsThatShow) {
  WorldScore score;
  score.verdicts = {named("push", "impulse_newton_seconds", 3, {4, 3, 5}),
                    named("push", "impulse_newton_seconds", 3, {4, 3, 5}),
                    named("push", "impulse_newton_seconds", 3, {4, 3, 5})};
  score.verdicts[0].kind = "pair";
  score.verdicts[1].verdict.answer.undetectable_expected = true;
  score.verdicts[2].verdict.diagnosis.causes.front().parameters.clear();
  EXPECT_TRUE(found_numbers(score).empty());
}

}  // namespace
}  // namespace umbsim::worlds
