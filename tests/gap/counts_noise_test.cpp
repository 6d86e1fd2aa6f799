#include "gap/noise/counts_noise.h"

#include <gtest/gtest.h>

#include <cmath>

namespace umbsim::gap {
namespace {

/// Four runs alike and two fast ones.
Recording six_runs() {
  Recording r;
  r.path.linear_speed_mps = 0.2;
  r.path.linear_acceleration_mps2 = 0.25;
  r.path.angular_speed_radps = 0.75;
  r.path.angular_acceleration_radps2 = 1.5;
  r.runs.resize(6);
  for (std::size_t i : {4u, 5u}) r.runs[i].linear_speed_mps = 0.4;
  return r;
}

std::vector<CommandResponse> features(const std::vector<double>& left_gains, double lag_s = 0) {
  std::vector<CommandResponse> all;
  for (const double g : left_gains) {
    CommandResponse f;
    f.known = true;
    f.left_gain = g;
    f.lag_s = lag_s;
    all.push_back(f);
  }
  return all;
}

const std::vector<CommandResponse> kForetold = features({0, 0, 0, 0, 0, 0});

// Squares about each group's mean: (4 and 2 runs) with 3 + 1 degrees of freedom of each wheel, beside eight usual ones.
TEST(CountsNoise, GainsScatterAsRunsAlikeSay) {
  const double usual = 4e-4;
  const double sd =
      gain_scatter(grouped(six_runs()), features({1e-3, -1e-3, 1e-3, -1e-3, 5e-3, 7e-3}), kForetold, usual);
  EXPECT_NEAR(sd, std::sqrt((8 * usual * usual + 4e-6 + 2e-6) / (8 + 3 + 1 + 3 + 1)), 1e-12);
}

TEST(CountsNoise, AGainThatAllRunsShareIsNoScatter) {
  EXPECT_EQ(gain_scatter(grouped(six_runs()), features({5e-3, 5e-3, 5e-3, 5e-3, 8e-3, 8e-3}), kForetold, 4e-4), 4e-4);
  std::vector<CommandResponse> unknown(6);
  EXPECT_EQ(gain_scatter(grouped(six_runs()), unknown, kForetold, 4e-4), 4e-4);
}

// A lag of 0.1 s is an eighth of a ramp of 0.8 s and a fifth of one of 0.5 s.
TEST(CountsNoise, CommandsSayLessOfADemandTheMoreCountsLag) {
  const CommandFeatures prompt = command_features_sd(six_runs(), kForetold, kForetold);
  const CommandFeatures late = command_features_sd(six_runs(), features({0, 0, 0, 0, 0, 0}, 0.1), kForetold);
  EXPECT_NEAR(late[0], std::hypot(prompt[0], 0.1 / 0.8), 1e-12);
  EXPECT_NEAR(late[1], std::hypot(prompt[1], 0.1 / 0.5), 1e-12);
  for (std::size_t i = 2; i < late.size(); ++i) EXPECT_EQ(late[i], prompt[i]);
}

}  // namespace
}  // namespace umbsim::gap
