// Loads of robots on more than three supports, against hand calculation.
#include "sim/model/suspension.h"

#include <gtest/gtest.h>

namespace umbsim {
namespace {

constexpr double kG = 10;

// 20 kg on wheels at (0, +-0.2) and balls; the centre of mass `ahead` of the axle, 0.1 m above the floor.
RobotModel on_balls(const std::vector<Eigen::Vector3d>& balls, double ahead_m) {
  RobotModel robot;
  robot.base = {18, {ahead_m * 20 / 18, 0, 0}, 0.3 * Eigen::Matrix3d::Identity()};
  for (int i = 0; i < 2; ++i) {
    Wheel& w = robot.wheels[i];
    w.centre_m = {0, i == 0 ? 0.2 : -0.2, 0};
    w.radius_m = 0.1;
    w.mass_kg = 1;
    w.spin_inertia_kgm2 = 0.005;
    w.transverse_inertia_kgm2 = 0.003;
  }
  for (const Eigen::Vector3d& at : balls) {
    Caster c;
    c.centre_m = at;
    c.radius_m = 0.03;
    robot.casters.push_back(c);
  }
  return robot;
}

TEST(RestLoads, ThreeSupportsByStatics) {
  const std::vector<double> loads = rest_loads(on_balls({{0.3, 0, -0.07}}, 0.06), kG);
  ASSERT_EQ(loads.size(), 3u);  // 200 N, a fifth of the way to the ball
  EXPECT_NEAR(loads[0], 80, 1e-9);
  EXPECT_NEAR(loads[1], 80, 1e-9);
  EXPECT_NEAR(loads[2], 40, 1e-9);
}

// Equal springs: F = a + b x. Sum 4 a = W; moment b 2 c^2 = W x.
TEST(RestLoads, FourSupportsAsOnEqualSprings) {
  const std::vector<double> loads = rest_loads(on_balls({{0.3, 0, -0.07}, {-0.3, 0, -0.07}}, 0.03), kG);
  ASSERT_EQ(loads.size(), 4u);
  EXPECT_NEAR(loads[0], 50, 1e-9);
  EXPECT_NEAR(loads[1], 50, 1e-9);
  EXPECT_NEAR(loads[2], 50 + 200 * 0.03 / 0.6, 1e-9);
  EXPECT_NEAR(loads[3], 50 - 200 * 0.03 / 0.6, 1e-9);
}

// F = a + b x: 6 a = W; b 4 c^2 = W x.
TEST(RestLoads, SixSupports) {
  const std::vector<double> loads = rest_loads(
      on_balls({{0.3, 0.15, -0.07}, {0.3, -0.15, -0.07}, {-0.3, 0.15, -0.07}, {-0.3, -0.15, -0.07}}, 0.06), kG);
  ASSERT_EQ(loads.size(), 6u);
  const double even = 200.0 / 6, more = 200 * 0.06 / (4 * 0.3);
  EXPECT_NEAR(loads[0], even, 1e-9);
  EXPECT_NEAR(loads[2], even + more, 1e-9);
  EXPECT_NEAR(loads[3], even + more, 1e-9);
  EXPECT_NEAR(loads[4], even - more, 1e-9);
}

TEST(RestLoads, ASupportThatWouldHaveToPullCarriesNothing) {
  // Equal springs would give the rear ball 50 - 200 * 0.2 / 0.6 < 0: the other three carry by statics.
  const std::vector<double> loads = rest_loads(on_balls({{0.3, 0, -0.07}, {-0.3, 0, -0.07}}, 0.2), kG);
  ASSERT_EQ(loads.size(), 4u);
  EXPECT_DOUBLE_EQ(loads[3], 0);
  EXPECT_NEAR(loads[2], 200 * 0.2 / 0.3, 1e-9);
  EXPECT_TRUE(rest_loads(on_balls({{0.3, 0, -0.07}}, -0.01), kG).empty());
}

TEST(Suspensions, ThreeSupportsStayRigid) {
  RobotModel robot = on_balls({{0.3, 0, -0.07}}, 0.06);
  suspend(robot, {}, kG, 0.01);
  EXPECT_EQ(robot.wheels[0].suspension, Suspension{});
  EXPECT_EQ(robot.casters[0].suspension, Suspension{});
}

TEST(Suspensions, DefaultTravelGrowsWithTheFloor) {
  RobotModel robot = on_balls({{0.3, 0, -0.07}, {-0.3, 0, -0.07}}, 0);
  suspend(robot, {}, kG, 0);
  EXPECT_NEAR(robot.wheels[0].suspension.up_m, 0.010, 1e-12);
  EXPECT_NEAR(robot.wheels[0].suspension.stiffness_npm, 50 / 0.010, 1e-6);
  suspend(robot, {}, kG, 0.003);
  EXPECT_NEAR(robot.wheels[0].suspension.up_m, 0.012, 1e-12);
  // At most: sum of F d^2 = 4 W h sink. Along x 2 * 50 * 0.09 = 9, along y 2 * 50 * 0.04 = 4 = 4 * 200 * 0.1 * 0.05.
  suspend(robot, {}, kG, 0.02);
  EXPECT_NEAR(robot.wheels[0].suspension.up_m, 0.05, 1e-12);
}

TEST(Suspensions, ByTheScenarioAndByTheUrdf) {
  RobotModel robot = on_balls({{0.3, 0, -0.07}}, 0.06);
  suspend(robot, {0.02, 0.0, 0.5}, kG, 0);
  const Suspension& s = robot.wheels[0].suspension;
  EXPECT_NEAR(s.stiffness_npm, 80 / 0.01, 1e-6);
  EXPECT_NEAR(s.damping_nspm, 2 * 0.5 * std::sqrt(8000 * 8.0), 1e-6);  // the load's mass is 8 kg
  EXPECT_FALSE(robot.casters[0].suspension.sprung());
  EXPECT_NEAR(robot.casters[0].suspension.rest_load_n, 40, 1e-9);
  robot.wheels[0].slide = {"drop", 0, 0.03, 400, 12};
  suspend(robot, {}, kG, 0);
  EXPECT_EQ(robot.wheels[0].suspension.preload_n, 12);  // carries 80 N: it stands on its upper stop
  EXPECT_EQ(robot.wheels[0].suspension.up_m, 0);
  EXPECT_FALSE(robot.wheels[1].suspension.sprung());
}

}  // namespace
}  // namespace umbsim
