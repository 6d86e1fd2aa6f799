// The rolling step on a plane (sim/plane.cpp) is the general step to round-off, and is left where it does not hold.
#include <gtest/gtest.h>

#include "sim/snapshot.h"
#include "tests/sim/rolling_robot.h"

namespace umbsim {
namespace {

using testing::labmate;
using testing::small_robot;
using testing::trip;

constexpr double kSame = 1e-10;        // m, rad
constexpr double kSameSliding = 1e-8;  // both steps end Newton's method within a tolerance of their own

struct Drive {
  RobotModel robot = labmate();
  Floor floor{};
  double torque_limit_nm = 20;
  double fastest_radps = 5;
  double slow_wheel = 1;  // factor of the right wheel's rolling radius
  double same = kSame;
};

// A bend, a turn in place and a way back.
World driven(const Drive& d, bool general) {
  PhysicsOptions options;
  options.general_steps = general;
  World world(d.robot, {d.torque_limit_nm}, d.floor, options);
  world.place({0.1, -0.2, 0.4});
  world.scale_rolling_radius(1, d.slow_wheel);
  trip(world, d.fastest_radps, 0.8 * d.fastest_radps, 1);
  trip(world, -d.fastest_radps, d.fastest_radps, 2);
  trip(world, -0.5 * d.fastest_radps, -0.4 * d.fastest_radps, 1);
  return world;
}

void expect_same(const Drive& d) {
  const World a = driven(d, false), b = driven(d, true);
  EXPECT_NEAR(a.pose().x_m, b.pose().x_m, d.same);
  EXPECT_NEAR(a.pose().y_m, b.pose().y_m, d.same);
  EXPECT_NEAR(a.pose().theta_rad, b.pose().theta_rad, d.same);
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(a.wheel_angle(i), b.wheel_angle(i), d.same);
    EXPECT_NEAR(a.loads().wheel_n[std::size_t(i)], b.loads().wheel_n[std::size_t(i)], 1e-6);
    EXPECT_NEAR(a.strain(i).least_n, b.strain(i).least_n, 1e-6);
  }
  EXPECT_NEAR(double(a.cost().newton_steps), double(b.cost().newton_steps), 0.01 * double(b.cost().newton_steps));
}

TEST(WorldPlane, IsTheGeneralStep) {
  expect_same({});
  expect_same({small_robot()});
}

// Toed wheels that creep a lot along and hardly across: friction's tangent has pivots of either sign.
TEST(WorldPlane, IsTheGeneralStepOnToedWheelsThatCreep) {
  RobotModel robot = labmate();
  robot.wheels[0].axis = Eigen::Vector3d(0.012, 1, 0).normalized();
  for (Wheel& w : robot.wheels) w.creep_along = 0.4, w.creep_across = 0.003;
  const Drive toed{robot, {}, 20, 5, 1, kSameSliding};
  expect_same(toed);
  const PhysicsCost cost = driven(toed, false).cost();
  EXPECT_LT(double(cost.general_steps), 0.01 * double(cost.steps));
}

TEST(WorldPlane, IsTheGeneralStepForACrookedRobot) {
  RobotModel robot = labmate();
  robot.base.com_m.y() = 0.03;
  robot.base.inertia_kgm2(0, 1) = robot.base.inertia_kgm2(1, 0) = 0.05;
  robot.wheels[0].radius_m *= 1.01;
  robot.wheels[0].axis = Eigen::Vector3d(0.02, 1, 0.03).normalized();
  robot.wheels[1].compliance_mpn = 1e-6;
  expect_same({robot, {}, 20, 5, 0.995});
}

TEST(WorldPlane, IsTheGeneralStepWithTwoBalls) {
  RobotModel robot = labmate();
  robot.casters.push_back(robot.casters[0]);
  robot.casters[0].centre_m.y() = 0.15;
  robot.casters[1].centre_m.y() = -0.15;
  expect_same({robot});
}

TEST(WorldPlane, IsTheGeneralStepOnASlope) {
  Floor floor;
  floor.slope_rad = 0.03;
  floor.downhill_rad = 1;
  expect_same({labmate(), floor});
}

// Where wheels spin, motors give in, or a wheel lifts, the other steps take over and hand back.
TEST(WorldPlane, IsLeftWhereItDoesNotHold) {
  Floor slippery;
  slippery.friction = 0.05;
  const Drive slides{labmate(), slippery, 20, 20, 1, kSameSliding};
  EXPECT_GT(driven(slides, false).cost().newton_steps, 10);
  expect_same(slides);
  const Drive weak{labmate(), {}, 0.6, 20, 1, kSameSliding};
  EXPECT_GT(driven(weak, false).cost().newton_steps, 10);
  expect_same(weak);
}

TEST(WorldPlane, IsLeftAtACable) {
  Floor floor;
  floor.cables.push_back({0.6, -0.1, 1.2, 0.008, 0.5});
  floor.cables.push_back({0.3, 0.4, 0.2, 0.002, 0.3});
  const Drive d{labmate(), floor, 20, 5, 1, kSameSliding};
  EXPECT_GT(driven(d, false).cost().newton_steps, 10);
  expect_same(d);
}

TEST(WorldPlane, IsLeftWhileThereIsAPush) {
  PhysicsOptions general;
  general.general_steps = true;
  const std::vector<Push> push{[] {
    Push p;
    p.time_s = 1;
    p.duration_s = 0.3;
    p.impulse_ns = 5;
    p.height_m = 0.2;
    return p;
  }()};
  World a(labmate(), {20.0}, {}, {}, push), b(labmate(), {20.0}, {}, general, push);
  for (World* w : {&a, &b}) {
    w->place({});
    trip(*w, 3, 3, 2);
  }
  EXPECT_NEAR(a.pose().x_m, b.pose().x_m, kSame);
  EXPECT_NEAR(a.pose().theta_rad, b.pose().theta_rad, kSame);
}

// To the bit, whatever the world that goes on did before: here it spins its wheels.
TEST(WorldPlane, GoesOnFromASnapshot) {
  Floor slippery;
  slippery.friction = 0.3;
  World a(labmate(), {20.0}, slippery, {}), b(labmate(), {20.0}, slippery, {});
  a.place({});
  trip(a, 3, 2, 1);
  b.place({});
  testing::drive(b, 60, 60, 0.5);
  ASSERT_GT(b.strain(0).slid_s, 0.1);
  const Snapshot then = a.snapshot();
  b.resume(then, {});
  for (World* w : {&a, &b}) {
    testing::drive(*w, 5, 5, 0.1);  // slides
    testing::drive(*w, 5, 5.5, 1);
  }
  ASSERT_GT(a.strain(0).slid_s, 0);
  EXPECT_EQ(a.pose().x_m, b.pose().x_m);
  EXPECT_EQ(a.pose().y_m, b.pose().y_m);
  EXPECT_EQ(a.pose().theta_rad, b.pose().theta_rad);
}

}  // namespace
}  // namespace umbsim
