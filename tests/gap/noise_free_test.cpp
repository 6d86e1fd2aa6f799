// The first experiment that anyone tries: one effect, no noise at all. Runs that repeat to the last digit say nothing
// of what a replay of their counts misses.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <utility>
#include <vector>

#include "gap/noise/least_noise.h"
#include "tests/gap/subject.h"

namespace umbsim::gap {
namespace {

using testing::effect;
using testing::Subject;
using Numbers = std::vector<std::pair<std::string, double>>;

struct Case {
  const char* effect;
  Numbers labmate;
  Numbers small;            // of the 3 kg robot
  Effect believed = {};     // what the scenario is known to have beside it
  bool in_the_set = false;  // plain squares cannot tell it from other things that repeat
};

constexpr double kLabmateSide_m = 1.5;
constexpr double kSmallSide_m = 1;
constexpr int kPerDirection = 2;

Effect creep() { return effect("tyre_creep", {{"along", 0.02}, {"across", 0.02}}); }

// Typical sizes. Slopes, drag, toe and swivelling casters act through tyres that give way, loads through soft ones:
// alone they move no pose of a robot on rigid wheels, and that robot has no gap.
const std::vector<Case>& cases() {
  static const std::vector<Case> all = {
      {"wheel_radius_scale", {{"relative", 0.01}}, {{"relative", 0.01}}},
      {"wheel_radius_difference", {{"relative", 0.002}}, {{"relative", 0.002}}},
      {"wheelbase", {{"relative", 0.01}}, {{"relative", 0.01}}},
      {"wheel_misalignment", {{"right_toe_rad", 0.006}}, {{"right_toe_rad", 0.006}}, creep()},
      {"wheel_eccentricity", {{"right_m", 0.001}}, {{"right_m", 0.001}}},
      {"load_shift",
       {{"payload_kg", 5}, {"ahead_m", 0.05}, {"left_m", 0.05}},
       {{"payload_kg", 1}, {"ahead_m", 0.03}, {"left_m", 0.03}},
       effect("tyre_compliance", {{"metres_per_newton", 3e-6}})},
      {"wear", {{"right_relative_per_run", -0.0005}}, {{"right_relative_per_run", -0.0005}}},
      {"backlash", {{"left_rad", 0.02}, {"right_rad", 0.02}}, {{"left_rad", 0.02}, {"right_rad", 0.02}}},
      {"motor_response", {{"lag_s", 0.1}}, {{"lag_s", 0.1}}},
      {"over_acceleration", {{"factor", 10}}, {{"factor", 6}}},
      {"fast_turning", {{"factor", 4}}, {{"factor", 3}}},
      {"encoder_resolution", {{"ticks_per_revolution", 100}}, {{"ticks_per_revolution", 100}}},
      {"encoder_sampling", {{"interval_s", 0.1}}, {{"interval_s", 0.1}}},
      {"encoder_missed_counts", {{"right_probability", 0.002}}, {{"right_probability", 0.002}}},
      {"encoder_latency", {{"seconds", 0.1}}, {{"seconds", 0.1}}},
      {"tyre_compliance", {{"metres_per_newton", 1.5e-6}}, {{"metres_per_newton", 3e-6}}, {}, true},
      {"contact_patch", {{"width_m", 0.02}}, {{"width_m", 0.02}}},
      {"tyre_creep",
       {{"along", 0.05}, {"across", 0.05}},
       {{"along", 0.05}, {"across", 0.05}},
       effect("floor_slope", {{"slope_rad", 0.02}, {"downhill_rad", 1}})},
      {"caster_swivel", {{"trail_m", 0.03}, {"friction_nm", 0.2}}, {{"trail_m", 0.03}, {"friction_nm", 0.02}}, creep()},
      {"caster_drag", {{"coefficient", 0.03}, {"left_m", 0.05}}, {{"coefficient", 0.03}, {"left_m", 0.02}}, creep()},
      {"slippery_floor", {{"friction", 0.03}}, {{"friction", 0.03}}},
      {"slippery_patch",
       {{"x_m", 1.4}, {"y_m", -0.17}, {"radius_m", 0.3}, {"friction", 0.02}},
       {{"x_m", 0.95}, {"y_m", -0.1}, {"radius_m", 0.15}, {"friction", 0.02}}},
      {"bump",
       {{"height_m", 0.006}, {"x_m", 0.75}, {"y_m", -0.17}},
       {{"height_m", 0.004}, {"x_m", 0.5}, {"y_m", -0.1}}},
      {"uneven_floor", {{"rms_m", 0.001}}, {{"rms_m", 0.001}}, {}, true},
      {"floor_slope",
       {{"slope_rad", 0.02}, {"downhill_rad", 1}},
       {{"slope_rad", 0.02}, {"downhill_rad", 1}},
       creep(),
       true},
      {"carpet_drift",
       {{"metres_per_metre", 0.004}, {"direction_rad", 0.8}},
       {{"metres_per_metre", 0.004}, {"direction_rad", 0.8}}},
      {"push",
       {{"leg", 2}, {"seconds_into_leg", 3}, {"impulse_newton_seconds", 30}},
       {{"leg", 2}, {"seconds_into_leg", 2}, {"impulse_newton_seconds", 1.2}}},
      {"wheel_lift",
       {{"x_m", 1.45}, {"y_m", -0.17}, {"length_m", 0.1}},
       {{"x_m", 0.95}, {"y_m", -0.1}, {"length_m", 0.05}}},
  };
  return all;
}

bool is_there(const Effect& e) { return e.info != nullptr; }

Recording driven(const Case& c, bool small) {
  Scenario s = testing::squares(small ? kSmallSide_m : kLabmateSide_m, kPerDirection);
  s.encoders.ticks_per_revolution = 1000000;
  s.course.linear_speed_mps = 0.2;
  if (small) s.robot.urdf = "optiodom.urdf";
  s.effects = {effect(c.effect, small ? c.small : c.labmate, std::string(c.effect) == "push" ? "ccw-1" : "")};
  if (is_there(c.believed)) s.effects.push_back(c.believed);
  return run_experiment(s, 0).recording;
}

class NoiseFree : public ::testing::TestWithParam<std::tuple<std::size_t, bool>> {};

TEST_P(NoiseFree, IsNamed) {
  const auto [index, small] = GetParam();
  const Case& c = cases()[index];
  const Subject p(driven(c, small), is_there(c.believed) ? std::vector<Effect>{c.believed} : std::vector<Effect>{});
  const Diagnosis d = p.diagnosed();
  std::cout << c.effect << ": " << d.causes.front().name << ", " << d.before_mm << " mm, floor " << d.noise_floor_mm
            << " mm, set";
  for (const std::string& name : d.set) std::cout << " " << name;
  std::cout << "\n";
  if (!c.in_the_set) {
    EXPECT_EQ(d.causes.front().name, c.effect);
  }
  EXPECT_NE(std::find(d.set.begin(), d.set.end(), c.effect), d.set.end());
}

std::string name_of(const ::testing::TestParamInfo<NoiseFree::ParamType>& info) {
  const auto [index, small] = info.param;
  return std::string(cases()[index].effect) + (small ? "_small" : "_labmate");
}

INSTANTIATE_TEST_SUITE_P(Effects, NoiseFree,
                         ::testing::Combine(::testing::Range(std::size_t(0), cases().size()), ::testing::Bool()),
                         name_of);

TEST(NoiseFree, EveryEffectHasACase) {
  ASSERT_EQ(cases().size(), catalogue().size());
  for (const EffectInfo& info : catalogue()) {
    EXPECT_EQ(std::count_if(cases().begin(), cases().end(), [&](const Case& c) { return info.name == c.effect; }), 1)
        << info.name;
  }
}

TEST(NoiseFree, ARobotWithoutAnyFaultHasNoGap) {
  for (const bool small : {false, true}) {
    Scenario s = testing::squares(small ? kSmallSide_m : kLabmateSide_m, kPerDirection);
    if (small) s.robot.urdf = "optiodom.urdf";
    const Subject p(run_experiment(s, 0).recording);
    const Diagnosis d = p.diagnosed();
    EXPECT_EQ(d.causes.front().name, "none");
    EXPECT_FALSE(d.detected);
  }
}

// Half a count of the wheels, by hand: 2 pi 75 mm / 2000 / sqrt(12) = 0.0680 mm for each.
TEST(NoiseFree, NoiseIsNoLessThanCountsCanShow) {
  Scenario s = testing::squares(1, 2);
  const Recording alike = run_experiment(s, 0).recording;
  const Subject p(alike);
  constexpr double kHalfACount_m = 2 * M_PI * 0.075 / 2000 / 3.4641;
  EXPECT_GE(p.model.noise().position_sd_m, kHalfACount_m / M_SQRT2);
  EXPECT_GE(p.model.noise().heading_sd_rad, kHalfACount_m * M_SQRT2 / 0.34);
  EXPECT_TRUE(p.model.replicated());
}

}  // namespace
}  // namespace umbsim::gap
