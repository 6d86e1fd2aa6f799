// Effects outside the catalogue against what they say they do.
#include "bench/worlds/world/outside.h"

#include <gtest/gtest.h>

namespace umbsim::worlds {
namespace {

OutsideEffect effect(const std::string& name, double strength) {
  OutsideEffect e{&find_outside(name), {}};
  e.values = {{"wheel", 1}, {"sign", 1}, {"direction_rad", 0.5}, {"phase_rad", 0.2}, {"hertz", 1},
              {"x_m", 2},   {"y_m", 1},  {"radius_m", 0.5}};
  e.values[e.info->parameter] = strength;
  return e;
}

Moment rolling() {
  Moment now;
  now.slice_s = 0.02;
  now.wheel_radps = {4, 4};
  now.radius_m = {0.05, 0.05};
  now.wheelbase_m = 0.3;
  now.weight_n = 100;
  return now;
}

Acts act(const OutsideEffect& e, const Moment& now, Memory& memory) {
  Acts acts;
  e.info->act(e.values, now, memory, acts);
  return acts;
}

Memory fresh() { return {RandomStream(1, "test memory"), {}}; }

TEST(Outside, AreAtLeastEightAndNoneIsInTheCatalogue) {
  EXPECT_GE(outside_effects().size(), 8u);
  for (const OutsideInfo& info : outside_effects()) {
    for (const EffectInfo& known : catalogue()) EXPECT_NE(info.name, known.name);
  }
}

TEST(Outside, HeatingWheelNearsItsRadius) {
  Memory memory = fresh();
  Moment now = rolling();
  EXPECT_EQ(act(effect("heating_wheel", 0.01), now, memory).rolling[1], 1);
  now.time_s = 300;  // ten time constants
  EXPECT_NEAR(act(effect("heating_wheel", 0.01), now, memory).rolling[1], 1.01, 1e-6);
  EXPECT_EQ(act(effect("heating_wheel", 0.01), now, memory).rolling[0], 1);
}

TEST(Outside, BentAxleHasTwoWavesARevolutionAndNoMean) {
  Memory memory = fresh();
  Moment now = rolling();
  double sum = 0, correlation = 0;
  for (int k = 0; k < 360; ++k) {
    now.wheel_rad[1] = k * M_PI / 180;
    const double a = act(effect("bent_axle", 0.02), now, memory).rolling[1] - 1;
    sum += a;
    correlation += a * std::cos(2 * now.wheel_rad[1] + 0.2);
  }
  EXPECT_NEAR(sum, 0, 1e-9);
  EXPECT_NEAR(correlation / 180, 0.02, 1e-9);
}

TEST(Outside, WindPushesOnlyWhatMoves) {
  Memory memory = fresh();
  Moment now = rolling();
  const Acts acts = act(effect("wind", 0.1), now, memory);
  EXPECT_NEAR(std::hypot(acts.pull.force_x_n, acts.pull.force_y_n), 10, 1e-9);
  now.wheel_radps = {};
  EXPECT_EQ(act(effect("wind", 0.1), now, memory).pull.force_x_n, 0);
}

TEST(Outside, DraggedCablePullsBack) {
  Memory memory = fresh();
  Moment now = rolling();
  now.X_WB.theta_rad = M_PI / 2;  // along +y
  const Acts acts = act(effect("dragged_cable", 0.1), now, memory);
  EXPECT_NEAR(acts.pull.force_x_n, 0, 1e-9);
  EXPECT_NEAR(acts.pull.force_y_n, -10, 1e-9);
  EXPECT_LT(acts.pull.ahead_m, 0);
}

TEST(Outside, CountsDoubleAsOftenAsStated) {
  Memory memory = fresh();
  const Moment now = rolling();
  int doubled = 0;
  constexpr int kMoments = 20000;
  for (int k = 0; k < kMoments; ++k) doubled += act(effect("doubled_counts", 0.2), now, memory).counted[1] == 2;
  const double revolutions = kMoments * 4 * 0.02 / (2 * M_PI);
  EXPECT_NEAR(doubled / revolutions, 0.2, 0.04);  // some 50: sd 0.03 of a revolution's 0.2 is 0.028
}

TEST(Outside, PlacesActInTheirDiscAlone) {
  for (const char* name : {"local_drift", "rattling_encoder"}) {
    Memory memory = fresh();
    Moment now = rolling();
    now.X_WB = {2, 1.4, 0};
    Acts acts = act(effect(name, 0.1), now, memory);
    EXPECT_TRUE(acts.drift_x != 0 || acts.counted[1] != 1) << name;
    now.X_WB = {2, 1.6, 0};
    acts = act(effect(name, 0.1), now, memory);
    EXPECT_TRUE(acts.drift_x == 0 && acts.counted[1] == 1) << name;
  }
}

TEST(Outside, BrakeGrabsWhileTheRobotSlowsDown) {
  Memory memory = fresh();
  Moment now = rolling();
  EXPECT_EQ(act(effect("grabbing_brake", 0.1), now, memory).rolling[1], 1);
  now.wheel_radps = {3.9, 3.9};  // 5 mm/s less after 20 ms
  EXPECT_NEAR(act(effect("grabbing_brake", 0.1), now, memory).rolling[1], 1.1, 1e-12);
  EXPECT_EQ(act(effect("grabbing_brake", 0.1), now, memory).rolling[1], 1);
}

TEST(Outside, FlatSpotIsRoundAgainAfterAShortWay) {
  Memory memory = fresh();
  Moment now = rolling();
  const double first = act(effect("flat_spot", 0.05), now, memory).rolling[1];
  EXPECT_NEAR(first, 0.95, 0.005);
  double last = first;
  for (int k = 0; k < 500; ++k) last = act(effect("flat_spot", 0.05), now, memory).rolling[1];  // 2 m
  EXPECT_NEAR(last, 1, 1e-4);
}

TEST(Outside, TurnsToOneSideAlone) {
  Memory memory = fresh();
  Moment now = rolling();
  now.wheel_radps = {-2, 2};
  EXPECT_NEAR(act(effect("one_sided_turns", 0.02), now, memory).rolling[0], 1.02, 1e-12);
  now.wheel_radps = {2, -2};
  EXPECT_EQ(act(effect("one_sided_turns", 0.02), now, memory).rolling[0], 1);
}

}  // namespace
}  // namespace umbsim::worlds
