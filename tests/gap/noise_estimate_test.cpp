// The noise of a recording, from its repeated runs.
#include "gap/noise/noise_estimate.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/gap/subject.h"

namespace umbsim::gap {
namespace {

using testing::squares;
using testing::Subject;

// A camera's readings of squares, or circles.
Scenario seen_by_a_camera(int per_direction) {
  Scenario s = squares(2, per_direction);
  s.course.radius_m = 1;
  s.truth.position_sd_m = 0.002;
  s.truth.heading_sd_rad = 0.005;
  return s;
}

// Heading walk of the runs of a scenario, rad per square root of a metre, as its wheels make it and as it is estimated.
std::pair<double, double> made_and_estimated(Scenario s, double wheel_noise) {
  s.seed = 17;
  s.noise.wheel_noise_m_per_sqrt_m = wheel_noise;
  const Subject p(run_experiment(s, 0).recording);
  const double made = std::sqrt(2.0) * wheel_noise / p.recording.robot.wheelbase_m;
  const double estimated = std::sqrt(estimate_noise(p.model.nominal(), NoiseModel{}).noise.heading_rad2_pm);
  fmt::print("heading walk {:.5f} rad/sqrt(m), estimated {:.5f}\n", made, estimated);
  return {made, estimated};
}

TEST(NoiseEstimate, RepeatedEndPointsTellTheWalk) {
  for (const double wheel_noise : {1e-4, 1e-3}) {
    Scenario s = seen_by_a_camera(5);
    s.truth.kind = "endpoints";
    const auto [made, estimated] = made_and_estimated(s, wheel_noise);
    EXPECT_NEAR(std::log(estimated / made), 0, std::log(1.6));
  }
}

// One run each way repeats nothing: 6e-4.
TEST(NoiseEstimate, EndPointsThatDoNotRepeatLeaveWhatIsUsual) {
  Scenario s = seen_by_a_camera(1);
  s.truth.kind = "endpoints";
  EXPECT_NEAR(made_and_estimated(s, 1e-4).second, 6e-4, 1e-6);
}

TEST(NoiseEstimate, CirclesRepeatAsWellAsSquares) {
  Scenario s = seen_by_a_camera(3);
  s.course.shape = "circle";
  const auto [made, estimated] = made_and_estimated(s, 3e-4);
  EXPECT_NEAR(std::log(estimated / made), 0, std::log(1.4));
}

// Where radii are far off, every reading is an outlier at first. That must not make no noise at all likeliest.
TEST(NoiseEstimate, AHeaderThatIsFarOffLeavesTheWalk) {
  for (const double off : {0.01, 0.03, 0.1}) {
    Scenario s = seen_by_a_camera(1);
    s.course.shape = "circle";
    s.truth.position_sd_m = 0.001;
    s.effects.push_back(testing::effect("wheel_radius_scale", {{"relative", off}}));
    const auto [made, estimated] = made_and_estimated(s, 1e-3);
    EXPECT_NEAR(std::log(estimated / made), 0, std::log(1.6)) << off;
  }
}

// Where the counts turn the robot by a radian too much, runs that repeat each other part in directions of their own.
TEST(NoiseEstimate, ALongWayWithAWrongHeaderLeavesTheWalk) {
  for (const int per_direction : {1, 2}) {
    Scenario s = squares(2, per_direction);
    s.course.laps = 8;
    s.truth.position_sd_m = 3e-4;
    s.truth.heading_sd_rad = 3e-4;
    s.effects.push_back(testing::effect("wheelbase", {{"relative", 0.03}}));
    const auto [made, estimated] = made_and_estimated(s, 3e-4);
    EXPECT_NEAR(std::log(estimated / made), 0, std::log(1.4)) << per_direction;
  }
}

}  // namespace
}  // namespace umbsim::gap
