// Every engine of the proving ground against what mechanics says of a robot on wheels.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "bench/worlds/checks/robots.h"
#include "bench/worlds/engines/engine.h"
#include "core/error.h"
#include "effects/contact.h"
#include "effects/geometry.h"

namespace umbsim::worlds {
namespace {

constexpr double kPeriod_s = 0.02;

class Engines : public ::testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<Engine> built(const Rig& rig, const Pose2& X_WB = {}) const {
    return kind_.build({rig, X_WB, 1}, middle_options(kind_));
  }
  const EngineKind& kind_ = find_engine(GetParam());
};

// From rest up to these wheel speeds, along, and back to rest.
void drive(Engine& e, double left_radps, double right_radps, double along_s) {
  constexpr double kRamp_s = 1;
  for (double t = kPeriod_s; t < along_s + 2 * kRamp_s + 0.3; t += kPeriod_s) {
    const double share = std::clamp(std::min(t, along_s + 2 * kRamp_s - t) / kRamp_s, 0.0, 1.0);
    e.advance({share * left_radps, share * right_radps}, kPeriod_s);
  }
}

Pose2 by_wheels(const Engine& e, const Rig& rig) {
  const double left_m = e.wheel_angle(0) * rig.robot.wheels[0].radius_m;
  const double right_m = e.wheel_angle(1) * rig.robot.wheels[1].radius_m;
  return arc((left_m + right_m) / 2, (right_m - left_m) / rig.robot.wheelbase_m());
}

// How engines differ is what this ground is for; half a per cent is what a wheel may creep on a level floor.
constexpr double kCreep = 0.005;

TEST_P(Engines, RollsAsFarAsItsWheelsTurn) {
  for (const Size size : kSizes) {
    const Rig rig = plain_rig(size);
    const std::unique_ptr<Engine> e = built(rig, {1, 2, 0});
    const double radps = 0.25 / rig.robot.wheels[0].radius_m;
    drive(*e, radps, radps, 4);
    const double way_m = by_wheels(*e, rig).x_m;
    std::cout << name(size) << ": " << 100 * ((e->pose().x_m - 1) / way_m - 1) << " % further than its wheels\n";
    EXPECT_NEAR(way_m, 1.25, 0.03);
    EXPECT_NEAR(e->pose().x_m - 1, way_m, kCreep * way_m);
    EXPECT_NEAR(e->pose().y_m, 2, kCreep * way_m);
    EXPECT_LT(e->tilt_rad(), 0.02);
  }
}

TEST_P(Engines, TurnsAsItsWheelbaseSays) {
  for (const Size size : kSizes) {
    const Rig rig = plain_rig(size);
    const std::unique_ptr<Engine> e = built(rig);
    const double radps = 0.5 * rig.robot.wheelbase_m() / 2 / rig.robot.wheels[0].radius_m;
    drive(*e, -radps, radps, 12);
    const double turned_rad = by_wheels(*e, rig).theta_rad;
    std::cout << name(size) << ": " << 100 * (e->pose().theta_rad / turned_rad - 1) << " % further than its wheels\n";
    EXPECT_NEAR(turned_rad, 6.5, 0.1);
    EXPECT_NEAR(e->pose().theta_rad, turned_rad, 2 * kCreep * turned_rad);
  }
}

TEST_P(Engines, UnequalRadiiDriveAnArc) {
  Rig rig = plain_rig(Size::middle);
  apply(WheelRadiusDifference{0.02}, rig);
  const std::unique_ptr<Engine> e = built(rig);
  drive(*e, 3, 3, 8);
  const Pose2 expected = by_wheels(*e, rig);
  EXPECT_NEAR(e->pose().theta_rad, expected.theta_rad, 0.1 * expected.theta_rad);
  EXPECT_NEAR(e->pose().x_m, expected.x_m, kCreep * expected.x_m);
}

TEST_P(Engines, RollingFactorIsARadius) {
  const Rig rig = plain_rig(Size::middle);
  const std::unique_ptr<Engine> e = built(rig);
  e->set_rolling_factor(1, 1.01);
  drive(*e, 3, 3, 8);
  const double left_m = e->wheel_angle(0) * 0.075, right_m = e->wheel_angle(1) * 0.075 * 1.01;
  const double expected_rad = (right_m - left_m) / rig.robot.wheelbase_m();
  EXPECT_NEAR(e->pose().theta_rad, expected_rad, 0.1 * expected_rad);
}

TEST_P(Engines, CarpetCarriesWhatRolls) {
  const Rig rig = plain_rig(Size::middle);
  const std::unique_ptr<Engine> e = built(rig), level = built(rig);
  e->set_carpet_drift(0, 0.01);
  drive(*e, 3, 3, 4);
  drive(*level, 3, 3, 4);
  const double way_m = e->wheel_angle(0) * 0.075;
  EXPECT_NEAR(e->pose().y_m - level->pose().y_m, 0.01 * way_m, 0.1 * 0.01 * way_m);
}

// A carpet carries the robot by the mean way of its wheels: on an arc, where the outer one rolls further, it does not turn.
TEST_P(Engines, CarpetTurnsNoRobotOnAnArc) {
  const Rig rig = plain_rig(Size::middle);
  const std::unique_ptr<Engine> e = built(rig), level = built(rig);
  e->set_carpet_drift(0.01, 0);
  drive(*e, 3, 4, 4);
  drive(*level, 3, 4, 4);
  const double turned_rad = level->pose().theta_rad;
  const double by_each_wheel_rad = 0.01 * std::sin(turned_rad);
  ASSERT_GT(by_each_wheel_rad, 0.005) << "else this shows nothing";
  EXPECT_NEAR(e->pose().theta_rad - level->pose().theta_rad, 0, 0.1 * by_each_wheel_rad);
}

// Without grip, and without a push through the ball, a force is momentum.
TEST_P(Engines, APullIsMomentum) {
  Rig rig = plain_rig(Size::middle);
  rig.floor.friction = 0;
  const std::unique_ptr<Engine> e = built(rig);
  Pull pull;
  pull.force_x_n = 50;
  e->set_pull(pull);
  e->advance({0, 0}, 0.2);
  e->set_pull({});
  const double before_m = e->pose().x_m;
  e->advance({0, 0}, 0.1);
  const double expected_mps = 50 * 0.2 / rig.robot.total_mass_kg();
  EXPECT_NEAR((e->pose().x_m - before_m) / 0.1, expected_mps, 0.03 * expected_mps);
}

// The heading by which a round cable's longer way turns the robot.
TEST_P(Engines, CableTurnsByItsClosedForm) {
  constexpr double kHeight_m = 0.004, R = 0.075, r = kHeight_m / 2;
  Rig rig = plain_rig(Size::middle);
  const double b_m = rig.robot.wheelbase_m();
  const std::unique_ptr<Engine> level = built(rig);
  rig.floor.cables.push_back({0.6, -b_m / 2, M_PI / 2, kHeight_m, 0.1});
  const std::unique_ptr<Engine> e = built(rig);
  drive(*level, 2, 2, 8);
  drive(*e, 2, 2, 8);
  const double longer_m = 2 * (R + r) * std::acos((R - r) / (R + r)) - 4 * std::sqrt(R * r);
  const auto off_rad = [&](const Engine& x) { return x.pose().theta_rad - by_wheels(x, rig).theta_rad; };
  const double turned_rad = off_rad(*e) - off_rad(*level);
  std::cout << -turned_rad * b_m / longer_m << " of the closed form\n";
  EXPECT_NEAR(turned_rad, -longer_m / b_m, 0.1 * longer_m / b_m);
}

// On a slope without grip it slides as gravity says.
TEST_P(Engines, SlopesPullDownhill) {
  Rig rig = plain_rig(Size::middle);
  rig.floor.slope_rad = 0.03;
  rig.floor.downhill_rad = 0;
  rig.floor.friction = 0.02;
  const std::unique_ptr<Engine> e = built(rig);
  const double from_m = e->pose().x_m;
  e->advance({0, 0}, 0.2);
  EXPECT_GT(e->pose().x_m - from_m, -1e-6);
  EXPECT_LT(std::abs(e->pose().y_m), 0.002);
}

TEST_P(Engines, StandsOnASwivellingCaster) {
  Rig rig = plain_rig(Size::middle);
  Caster& c = rig.robot.casters[0];
  c.swivels = true;
  c.centre_m.x() *= -1;
  rig.robot.base.com_m.x() *= -1;
  c.swivel_point_m = c.centre_m + Eigen::Vector3d(0.03, 0, 0);
  c.fork = {0.2, c.centre_m + Eigen::Vector3d(0.01, 0, 0.02), Eigen::Vector3d(1e-4, 1e-4, 1e-4).asDiagonal()};
  c.wheel_mass_kg = 0.1;
  c.wheel_spin_inertia_kgm2 = 5e-5;
  c.wheel_transverse_inertia_kgm2 = 3e-5;
  c.swivel_friction_nm = 0.01;
  const std::unique_ptr<Engine> e = built(rig);
  drive(*e, 3, 3, 2);
  const Pose2 expected = by_wheels(*e, rig);
  EXPECT_NEAR(e->pose().x_m, expected.x_m, 0.01 * expected.x_m);
  EXPECT_LT(e->tilt_rad(), 0.02);
}

TEST_P(Engines, SameBytesTwice) {
  const auto end = [&] {
    Rig rig = plain_rig(Size::small);
    apply(ContactPatch{0.01}, rig);
    const std::unique_ptr<Engine> e = built(rig);
    drive(*e, 3, 4, 2);
    return e->pose();
  };
  const Pose2 once = end(), again = end();
  EXPECT_EQ(once.x_m, again.x_m);
  EXPECT_EQ(once.y_m, again.y_m);
  EXPECT_EQ(once.theta_rad, again.theta_rad);
}

// No more effects than it says, and the bars of how many.
TEST_P(Engines, ExpressTheCataloguesEffects) {
  const std::map<std::string, std::size_t> least{{"ours", 28}, {"mujoco", 20}, {"bullet", 18}, {"planar", 15}};
  EXPECT_GE(kind_.expresses.size(), least.at(GetParam()));
  for (const auto& [effect, how] : kind_.expresses) {
    EXPECT_NO_THROW(find_effect(effect)) << effect;
    EXPECT_FALSE(how.empty());
  }
}

// A droop that an engine would not act on is never left out in silence.
TEST_P(Engines, DroopActsOrIsRefused) {
  Rig rig = plain_rig(Size::middle);
  for (Motor& m : rig.drivetrain.motor) m.droop_radps_per_nm = 0.1;
  if (GetParam() == "ours")
    EXPECT_NO_THROW(built(rig));
  else
    EXPECT_THROW(built(rig), InputError);
}

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const EngineKind& kind : engines()) all.push_back(kind.name);
  return all;
}

INSTANTIATE_TEST_SUITE_P(Worlds, Engines, ::testing::ValuesIn(names()),
                         [](const ::testing::TestParamInfo<std::string>& engine) { return engine.param; });

// Shapes and solvers as users take them: each stands and rolls.
TEST(Bullet, EveryShapeAndSolverRolls) {
  const EngineKind& kind = find_engine("bullet");
  const Rig rig = plain_rig(Size::middle);
  for (const char* solver : {"sequential_impulse", "dantzig"}) {
    for (const char* wheel : {"cylinder", "sphere", "convex"}) {
      for (const char* friction : {"sliding", "spinning", "rolling"}) {
        EngineOptions options = middle_options(kind);
        options.choices["solver"] = solver;
        options.choices["wheel"] = wheel;
        options.choices["friction"] = friction;
        const std::unique_ptr<Engine> e = kind.build({rig, {}, 1}, options);
        drive(*e, 3, 3, 4);
        const double way_m = by_wheels(*e, rig).x_m, far_m = e->pose().x_m;
        drive(*e, -1.5, 1.5, 4);
        const double turned_rad = by_wheels(*e, rig).theta_rad;
        std::cout << solver << ", " << wheel << ", " << friction << ": way " << 100 * (far_m / way_m - 1) << " %, turn "
                  << 100 * (e->pose().theta_rad / turned_rad - 1) << " %\n";
        EXPECT_NEAR(far_m, way_m, 0.01 * way_m);
      }
    }
  }
}

TEST(Bullet, WhatItCannotExpressIsRefused) {
  const EngineKind& kind = find_engine("bullet");
  Rig play = plain_rig(Size::middle), uneven = play;
  play.drivetrain.motor[0].backlash_rad = 0.01;
  uneven.floor.ripples.push_back({0.001, 10, 0, 0});
  EXPECT_THROW(kind.build({play, {}, 1}, middle_options(kind)), InputError);
  EXPECT_THROW(kind.build({uneven, {}, 1}, middle_options(kind)), InputError);
}

}  // namespace
}  // namespace umbsim::worlds
