// The world on a flat floor: statics, rolling without slip against exact kinematics, mirror images, refusals.
#include "sim/world.h"

#include <gtest/gtest.h>

#include <iostream>
#include <limits>

#include "core/error.h"
#include "tests/sim/rolling_robot.h"

namespace umbsim {
namespace {

using testing::drive;
using testing::kG;
using testing::labmate;
using testing::mirrored;
using testing::placed;
using testing::rigid;
using testing::small_robot;
using testing::trip;

// The critically damped springs have come to rest within 0.2 s (they are faster than 300 rad/s).
constexpr double kStatics = 1e-6;
// Contacts give 1e-9 m/s per newton; driving forces of 10 N for some seconds.
constexpr double kCreep_m = 1e-7;
constexpr double kCreep_rad = 1e-6;
// Sums of some thousand rounded steps.
constexpr double kMirror = 1e-9;

TEST(World, LoadsAtRestAreThoseOfStatics) {
  for (const PhysicsOptions& options : {PhysicsOptions{}, rigid()}) {
    const World world = placed(labmate(), {}, options);
    const double ball_n = 40 * kG * 0.06 / 0.25;
    const double wheel_n = (42 * kG - ball_n) / 2;
    EXPECT_NEAR(world.loads().caster_n[0], ball_n, kStatics * ball_n);
    EXPECT_NEAR(world.loads().wheel_n[0], wheel_n, kStatics * wheel_n);
    EXPECT_NEAR(world.loads().wheel_n[1], wheel_n, kStatics * wheel_n);
    std::cout << "loads " << world.loads().wheel_n[0] << " " << world.loads().wheel_n[1] << " "
              << world.loads().caster_n[0] << " N (" << wheel_n << ", " << ball_n << ")\n";
  }
}

TEST(World, OffCentreLoadPressesTheNearerWheel) {
  RobotModel robot = labmate();
  robot.base.com_m.y() = 0.02;
  const World world = placed(robot);
  const double ball_n = 40 * kG * 0.06 / 0.25;
  const double both_n = 42 * kG - ball_n;
  const double difference_n = 2 * 40 * kG * 0.02 / 0.34;  // moments about x: (N_L - N_R) b / 2 = m g y
  EXPECT_NEAR(world.loads().wheel_n[0], (both_n + difference_n) / 2, kStatics * both_n);
  EXPECT_NEAR(world.loads().wheel_n[1], (both_n - difference_n) / 2, kStatics * both_n);
}

TEST(World, StandsWhereItIsPlaced) {
  World world(labmate(), {}, {}, {});
  world.place({1, -2, 2.5});
  EXPECT_NEAR(world.pose().x_m, 1, kCreep_m);
  EXPECT_NEAR(world.pose().y_m, -2, kCreep_m);
  EXPECT_NEAR(world.pose().theta_rad, 2.5, kCreep_rad);
  EXPECT_NEAR(world.up().z(), 1, kMirror);
  EXPECT_NEAR(world.wheel_centre(0).z(), 0.075, kCreep_m);
  EXPECT_EQ(world.wheel_angle(0), 0);
}

TEST(World, StraightDriveIsRadiusTimesAngle) {
  World world = placed(labmate());
  trip(world, 3, 3, 4);
  const Pose2 X_WB = world.pose();
  EXPECT_NEAR(world.wheel_angle(0), 3 * 5, 0.1) << "the motors follow their command";
  EXPECT_NEAR(X_WB.x_m, 0.075 * world.wheel_angle(0), kCreep_m);
  EXPECT_NEAR(X_WB.y_m, 0, kMirror);
  EXPECT_NEAR(X_WB.theta_rad, 0, kMirror);
  EXPECT_EQ(world.cost().solver_fallbacks, 0);
  std::cout << "straight: x - R phi = " << X_WB.x_m - 0.075 * world.wheel_angle(0) << " m\n";
}

TEST(World, TurnInPlaceIsWheelTravelOverWheelbase) {
  World world = placed(labmate());
  trip(world, -1.6, 1.6, 8);
  const Pose2 X_WB = world.pose();
  const double expected_rad = 0.075 * (world.wheel_angle(1) - world.wheel_angle(0)) / 0.340;
  EXPECT_GT(expected_rad, 2 * M_PI) << "more than a full turn: the heading must be unwrapped";
  EXPECT_NEAR(X_WB.theta_rad, expected_rad, kCreep_rad);
  EXPECT_NEAR(X_WB.x_m, 0, kCreep_m);
  EXPECT_NEAR(X_WB.y_m, 0, kCreep_m);
  EXPECT_EQ(world.cost().solver_fallbacks, 0);
  std::cout << "turn: heading - R dphi / b = " << X_WB.theta_rad - expected_rad << " rad, centre moved "
            << std::hypot(X_WB.x_m, X_WB.y_m) << " m\n";
}

// Wheel travel in a constant ratio: a circle about a point b/2 (s_R + s_L) / (s_R - s_L) to the left of the middle of
// the contact points. Where the wheels differ the axle leans, and both contact points stand `side_m` to its left.
Pose2 circle(double left_m, double right_m, double wheelbase_m, double side_m) {
  const double turn = (right_m - left_m) / wheelbase_m;
  const double radius_m = (left_m + right_m) / 2 / turn + side_m;  // of the axle's middle
  return {radius_m * std::sin(turn), radius_m * (1 - std::cos(turn)), turn};
}

// Rolling without slip is kinematics, and no length of step may show. Speeds keep their ratio, so the whole trip lies
// on one circle.
TEST(World, ArcsDoNotDependOnTheStep) {
  // The axle leans by dR / b = 3e-4; its square changes the distance of the contact points.
  constexpr double kLeanSquared = 1e-7;
  RobotModel robot = labmate();
  robot.wheels[1].radius_m = 0.0751;
  const double side_m = -0.07505 * 0.0001 / 0.340;
  for (const double step_s : {0.020, 0.010, 0.001}) {
    for (const double right_radps : {2.5, 2.8}) {
      PhysicsOptions options;
      options.step_s = step_s;
      World world = placed(robot, {}, options);
      trip(world, 2, right_radps, 5);
      const Pose2 X_WB = world.pose();
      const Pose2 expected = circle(0.075 * world.wheel_angle(0), 0.0751 * world.wheel_angle(1), 0.340, side_m);
      const double off_m = std::hypot(X_WB.x_m - expected.x_m, X_WB.y_m - expected.y_m);
      EXPECT_LT(off_m, kCreep_m + kLeanSquared);
      EXPECT_NEAR(X_WB.theta_rad, expected.theta_rad, kLeanSquared);
      EXPECT_EQ(world.cost().solver_fallbacks, 0);
      std::cout << "arc, step " << step_s << " s: off by " << off_m << " m, " << X_WB.theta_rad - expected.theta_rad
                << " rad\n";
    }
  }
}

// Steps of a fifth of a second, each at an even speed, lie on the same circle.
TEST(World, RollsOnACircleInLongSteps) {
  World world = placed(labmate());
  constexpr double kStep_s = 0.2, kLeft_radps = 2, kRight_radps = 2.5;
  for (int i = 1; i <= 20; ++i) {
    const double ramp = std::min(1.0, 0.1 * i), mean = std::min(1.0, 0.1 * (i - 0.5));
    world.command(ramp * kLeft_radps, ramp * kRight_radps);
    ASSERT_TRUE(world.roll({mean * kLeft_radps, mean * kRight_radps}, kStep_s));
  }
  EXPECT_NEAR(world.wheel_angle(0), 3 * kLeft_radps, 1e-9);
  EXPECT_EQ(world.wheel_speed(0), kLeft_radps);
  const Pose2 expected = circle(0.075 * world.wheel_angle(0), 0.075 * world.wheel_angle(1), 0.340, 0);
  const Pose2 X_WB = world.pose();
  EXPECT_LT(std::hypot(X_WB.x_m - expected.x_m, X_WB.y_m - expected.y_m), kCreep_m);
  EXPECT_NEAR(X_WB.theta_rad, expected.theta_rad, 1e-6);
}

// From rest to 1.5 m/s at once is more than friction gives. Nothing has happened then, and the run goes on as it would.
TEST(World, DoesNotSlideInALongStep) {
  World world = placed(labmate()), other = placed(labmate());
  for (World* w : {&world, &other}) w->command(20, 20);
  EXPECT_FALSE(world.roll({20, 20}, 0.1));
  EXPECT_EQ(world.pose().x_m, other.pose().x_m);
  EXPECT_EQ(world.wheel_speed(0), other.wheel_speed(0));
  for (World* w : {&world, &other}) w->advance(1);
  EXPECT_EQ(world.pose().x_m, other.pose().x_m);
}

TEST(World, TakesNoLongStepWithMotorsThatDoNotHold) {
  for (const double torque_nm : {0.0, 1e-3}) {
    World world(labmate(), {torque_nm}, {}, {});
    world.place({});
    world.command(1, 1);
    EXPECT_FALSE(world.roll({1, 1}, 0.1));
    EXPECT_NEAR(world.wheel_speed(0), 0, 1e-12);
  }
}

TEST(World, TakesNoLongStepWhereItsWayMatters) {
  const auto rolls = [](const RobotModel& robot, const Floor& floor, double backlash_rad) {
    Drivetrain drivetrain{20};
    for (Motor& m : drivetrain.motor) m.backlash_rad = backlash_rad;
    World world(robot, drivetrain, floor, {});
    world.place({});
    world.command(0.01, 0.01);
    return world.roll({0.01, 0.01}, 0.1);
  };
  EXPECT_TRUE(rolls(labmate(), {}, 0));
  EXPECT_FALSE(rolls(labmate(), {}, 0.01)) << "play";
  RobotModel eccentric = labmate();
  eccentric.wheels[0].eccentricity_m = 0.001;
  EXPECT_FALSE(rolls(eccentric, {}, 0));
  Floor patched, uneven, with_cable;
  patched.patches.push_back({1, 1, 0.1, 0.1});
  uneven.ripples = random_ripples(0.001, 1, 1, 0);
  with_cable.cables.push_back({0.04, 0.17, M_PI / 2, 0.01, 0.08});
  for (const Floor& floor : {patched, uneven, with_cable}) EXPECT_FALSE(rolls(labmate(), floor, 0));
}

TEST(World, MirroredRobotDrivesTheMirrorImage) {
  RobotModel robot = labmate();
  robot.base.com_m.y() = 0.015;
  robot.base.inertia_kgm2(0, 1) = robot.base.inertia_kgm2(1, 0) = 0.02;
  robot.wheels[0].radius_m = 0.0748;
  Floor slippery;
  slippery.friction = 0.3;
  for (const Floor& floor : {Floor{}, slippery}) {
    World world = placed(robot, floor), image = placed(mirrored(robot), floor);
    double worst = 0;
    for (int i = 0; i < 200; ++i) {  // the steps in the command make the wheels slip where it is slippery
      const double left = i / 50 % 2 == 0 ? 6 : -3, right = i / 70 % 2 == 0 ? 5 : 8;
      drive(world, left, right, 0.02);
      drive(image, right, left, 0.02);
      const Pose2 a = world.pose(), b = image.pose();
      worst = std::max({worst, std::abs(a.x_m - b.x_m), std::abs(a.y_m + b.y_m), std::abs(a.theta_rad + b.theta_rad)});
    }
    EXPECT_LE(worst, kMirror);
    EXPECT_GT(std::abs(world.pose().theta_rad), 0.1);
    std::cout << "mirror images, friction " << floor.friction << ": differ by " << worst
              << ", slipping or saturated in " << world.cost().newton_steps << " of " << world.cost().steps
              << " steps\n";
  }
}

TEST(World, SameCommandsSameBits) {
  World a = placed(labmate()), b = placed(labmate());
  trip(a, 3, 2, 2);
  trip(b, 3, 2, 2);
  EXPECT_EQ(a.pose().x_m, b.pose().x_m);
  EXPECT_EQ(a.pose().y_m, b.pose().y_m);
  EXPECT_EQ(a.pose().theta_rad, b.pose().theta_rad);
}

void expect_refused(const RobotModel& robot, const std::string& why) {
  try {
    placed(robot);
    ADD_FAILURE() << "accepted: " << why;
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("test robot: the robot does not stand"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("centre of mass must lie between"), std::string::npos) << e.what();
  }
}

TEST(World, RobotThatFallsOverIsRefused) {
  RobotModel robot = labmate();
  robot.base.com_m.x() = -0.05;
  expect_refused(robot, "centre of mass behind the axle, ball ahead");
  robot.base.com_m.x() = 0.30;
  expect_refused(robot, "centre of mass beyond the ball");
  robot.base.com_m = {0.06, 0.16, 0.05};
  expect_refused(robot, "centre of mass beside the left wheel's line to the ball");
}

TEST(World, RefusesCommandsThatNoWheelFollows) {
  World world = placed(labmate());
  EXPECT_NO_THROW(world.command(1e6, -1e6));
  for (const double radps : {1.001e6, -1e160, std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(world.command(0, radps), InputError) << radps;
    EXPECT_THROW(world.command(radps, 0), InputError) << radps;
  }
}

TEST(World, NonFiniteStateStopsTheRun) {
  World world = placed(labmate());
  world.command(std::numeric_limits<double>::quiet_NaN(), 0);
  try {
    world.advance(0.02);
    ADD_FAILURE() << "a state that is not a number went unnoticed";
  } catch (const RunError& e) {
    EXPECT_NE(std::string(e.what()).find("test robot: the state became non-finite after"), std::string::npos)
        << e.what();
  }
  World pushed(labmate(), {20}, {}, {}, {Push{0, 0.1, 1e300, 0, 0, 0}});
  pushed.place({});
  const auto run = [&] {
    for (int i = 0; i < 100; ++i) pushed.advance(0.02);
  };
  EXPECT_THROW(run(), RunError);
}

}  // namespace
}  // namespace umbsim
