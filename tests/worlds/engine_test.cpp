// This simulator behind the engines' interface, and what acts from outside.
#include <gtest/gtest.h>

#include "bench/worlds/run/severity.h"
#include "core/error.h"
#include "sim/world.h"

namespace umbsim::worlds {
namespace {

Rig rig() {
  Rig r;
  r.robot = make_robot("test", robot_urdf({}), 2000).model;
  for (Motor& m : r.drivetrain.motor) m.torque_limit_nm = 20;
  return r;
}

EngineOptions defaults() {
  return {{{"step_s", 0.01}, {"fine_step_s", 0.001}, {"static_sink_m", 0.00012}, {"damping_ratio", 2}}, {}};
}

// Worlds whose plain nominal robot stands and drives.
World world_of(const std::string& driver, std::uint64_t seed) {
  RandomStream random(seed, "test world");
  World w = draw_world(find_engine("ours"), {{driver}, {"mocap"}, {"plain_2"}, UMBSIM_ROBOTS_DIR}, random);
  w.robot = make_robot("test", robot_urdf({}), 2000);
  w.driver = {};
  w.driver.kind = driver;
  RandomStream runs(seed, "test runs");
  w.runs = plan_runs("plain_2", w.robot, w.driver.rate_hz, runs);
  w.options = defaults();
  w.physics = {};
  return w;
}

TEST(OurEngine, RollsAsFarAsItsWheelsTurn) {
  const std::unique_ptr<Engine> e = find_engine("ours").build({rig(), {1, 2, 0}, 1}, defaults());
  for (int k = 0; k < 200; ++k) e->advance({2, 2}, 0.02);
  EXPECT_NEAR(e->pose().x_m, 1 + 0.075 * e->wheel_angle(0), 1e-4);
  EXPECT_NEAR(e->pose().y_m, 2, 1e-6);
  EXPECT_NEAR(e->tilt_rad(), 0, 1e-3);
}

TEST(OurEngine, RollingFactorScalesTheWay) {
  const std::unique_ptr<Engine> e = find_engine("ours").build({rig(), {}, 1}, defaults());
  for (const int wheel : {0, 1}) e->set_rolling_factor(wheel, 1.02);
  for (int k = 0; k < 200; ++k) e->advance({2, 2}, 0.02);
  EXPECT_NEAR(e->pose().x_m, 1.02 * 0.075 * e->wheel_angle(0), 1e-3);
}

// The pose after a pull of 0.1 s, or after pushes as long; motors brake.
Pose2 after(const std::vector<Push>& pushes, const Pull& pull) {
  const Rig r = rig();
  umbsim::World world(r.robot, r.drivetrain, r.floor, {0.01, 0.001, 9.81, {}}, pushes);
  world.place({});
  world.set_pull(pull);
  world.advance(0.1);
  world.set_pull({});
  world.advance(0.5);
  return world.pose();
}

// When in a time step of 1 ms a push and a pull begin differs: at most that long at the speed that the impulse gives,
// 60 N s on 42 kg, and 20 N m s on the 1.6 kg m2 of the robot.
constexpr double kStepAlong_m = 0.001 * 60 / 42;
constexpr double kStepTurning_rad = 0.001 * 20 / 1.6;

// Both are the same impulse, and the tyres slip under it. Forward, and as a couple, it does not matter that a push turns
// with the robot.
TEST(OurEngine, APullIsAPush) {
  const Pose2 pushed = after({{0, 0.1, 60, 0, 0, 0.05}}, {}), pulled = after({}, {600, 0, 0, 0, 0.05, 0});
  EXPECT_GT(pushed.x_m, 0.01);
  EXPECT_NEAR(pulled.x_m, pushed.x_m, kStepAlong_m);
  const std::vector<Push> couple = {{0, 0.1, 20, M_PI / 2, 0.5, 0}, {0, 0.1, 20, -M_PI / 2, -0.5, 0}};
  const Pose2 turned = after(couple, {}), twisted = after({}, {0, 0, 0, 0, 0, 200});
  EXPECT_GT(turned.theta_rad, 0.01);
  EXPECT_NEAR(twisted.theta_rad, turned.theta_rad, kStepTurning_rad);
}

TEST(OurEngine, CarpetDriftFromNowOn) {
  const std::unique_ptr<Engine> e = find_engine("ours").build({rig(), {}, 1}, defaults());
  e->set_carpet_drift(0, 0.01);
  for (int k = 0; k < 200; ++k) e->advance({2, 2}, 0.02);
  EXPECT_NEAR(e->pose().y_m, 0.01 * 0.075 * e->wheel_angle(0), 2e-4);
}

TEST(Engines, UnknownNameListsTheChoices) {
  try {
    find_engine("havok");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("ours"), std::string::npos);
  }
}

// What the loop makes of effects in the catalogue is what their closed forms say: a larger wheelbase turns the robot
// less than its counts do.
TEST(WorldRun, WheelbaseTurnsLessThanTheCounts) {
  const World w = world_of("own", 3);
  Effect wheelbase = neutral_effect(find_effect("wheelbase"));
  wheelbase.values.numbers[0] = 0.02;
  const DrivenWorld driven = drive_world(w, {{{wheelbase}, {}}, {}, 1, 64});
  const Recording r = record_exactly(w, driven, 64);
  const SignalTrack track = signal_track(r, Signal::odometry);
  for (std::size_t run = 0; run < r.runs.size(); ++run) {
    // By the counts it turned by 2 pi, in truth by 1 / 1.02 of that.
    const double expected = 2 * M_PI * (1 - 1 / 1.02) * (r.runs[run].direction == "cw" ? 1 : -1);
    EXPECT_NEAR(track[run].back()[2], expected, 0.02 * std::abs(expected)) << r.runs[run].id;
  }
}

TEST(WorldRun, EffectsOutsideTheCatalogueMoveTheRobotOrItsCounts) {
  const World w = world_of("own", 3);
  const WorldScale scale(w, w, 5);
  EXPECT_LT(scale.of_the_world(), 1);
  const Way& way = w.runs.ways.front();
  for (const OutsideInfo& info : outside_effects()) {
    OutsideEffect e{&info, {}};
    e.values = {{"wheel", 1},       {"sign", 1},      {"direction_rad", 0.5},
                {"phase_rad", 0.2}, {"hertz", 1},     {"x_m", way.limits.side_m / 2},
                {"y_m", 0},         {"radius_m", 0.5}};
    e.values[info.parameter] = info.plausible.max;
    const WorldScale::Seen seen = scale.severity({{}, {e}});
    // Rigid tyres do not give way to a force that they can hold.
    if (info.name == "wind" || info.name == "dragged_cable") continue;
    EXPECT_GT(seen.severity, 0.5) << info.name;
  }
  EXPECT_EQ(scale.severity({}).severity, 0);
}

// The heading column of a tracker that sees none holds what the counts add up to, whatever the robot does.
TEST(WorldRun, HeadingsThatNobodySawAreCounted) {
  World w = world_of("own", 3);
  RandomStream random(1, "test tracker");
  w.tracker = draw_tracker("total_station", random);
  Effect wheelbase = neutral_effect(find_effect("wheelbase"));
  wheelbase.values.numbers[0] = 0.05;
  const DrivenWorld driven = drive_world(w, {{{wheelbase}, {}}, {}, 1, 1});
  const Recording r = record(w, driven, 1);
  for (std::size_t i = 0; i < r.runs.size(); ++i) {
    const double turned = r.runs[i].direction == "cw" ? -2 * M_PI : 2 * M_PI;
    EXPECT_NEAR(r.runs[i].truth.back().X_WB.theta_rad, turned, 0.01);
    EXPECT_NEAR(driven.runs[i].truth.back().X_WB.theta_rad, turned / 1.05, 0.02);
  }
}

// The recorder stops at a time that does not depend on what the robot does.
TEST(WorldRun, RecordsAsLongWhateverIsWrong) {
  const World w = world_of("heading", 4);
  Effect scale = neutral_effect(find_effect("wheel_radius_scale"));
  scale.values.numbers[0] = 0.03;
  const DrivenWorld plain = drive_world(w, {{}, {}, 1, 1}), wrong = drive_world(w, {{{scale}, {}}, {}, 1, 1});
  for (std::size_t i = 0; i < plain.runs.size(); ++i) {
    EXPECT_TRUE(plain.arrived[i]);
    EXPECT_EQ(plain.runs[i].encoders.size(), wrong.runs[i].encoders.size());
  }
}

}  // namespace
}  // namespace umbsim::worlds
