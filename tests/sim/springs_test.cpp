// Robots on more than three supports, on springs: loads by hand on flat and warped floors and while speeding up,
// rolling as exact as on rigid supports, cables.
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "sim/model/suspension.h"
#include "sim/snapshot.h"
#include "tests/sim/rolling_robot.h"

namespace umbsim {
namespace {

using testing::drive;
using testing::kG;
using testing::labmate;
using testing::placed;
using testing::trip;

constexpr double kStatic = 1e-5;   // of a load: what has not settled after a second
constexpr double kExact_m = 1e-6;  // 0.001 mm
constexpr double kCable = 0.03;

// The labmate with its weight over the axle, and balls in the place of the one.
RobotModel on_sprung_balls(const std::vector<Eigen::Vector2d>& places, double ahead_m = 0) {
  RobotModel robot = labmate();
  robot.base.com_m.x() = ahead_m * robot.total_mass_kg() / robot.base.mass_kg;
  const Caster ball = robot.casters[0];
  robot.casters.clear();
  for (const Eigen::Vector2d& at : places) {
    robot.casters.push_back(ball);
    robot.casters.back().centre_m.head<2>() = at;
  }
  return robot;
}

RobotModel four(double ahead_m = 0) { return on_sprung_balls({{0.25, 0}, {-0.25, 0}}, ahead_m); }
RobotModel six(double ahead_m = 0) {
  return on_sprung_balls({{0.25, 0.15}, {0.25, -0.15}, {-0.25, 0.15}, {-0.25, -0.15}}, ahead_m);
}

RobotModel sprung(RobotModel robot, const SuspensionChoice& choice = {}, double floor_rms_m = 0) {
  suspend(robot, choice, kG, floor_rms_m);
  return robot;
}

constexpr double kWeight_n = 42 * kG;

TEST(Springs, FourSupportsOnAFlatFloorByHand) {
  const World world = placed(sprung(four(0.02)));
  const SupportLoads& loads = world.loads();
  const double even = kWeight_n / 4, more = kWeight_n * 0.02 / 0.5;  // moments: (front - rear) 0.25 = W 0.02
  EXPECT_NEAR(loads.wheel_n[0], even, kStatic * even);
  EXPECT_NEAR(loads.wheel_n[1], even, kStatic * even);
  EXPECT_NEAR(loads.caster_n[0], even + more, kStatic * even);
  EXPECT_NEAR(loads.caster_n[1], even - more, kStatic * even);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(world.spring_up_m(i), 0, 1e-8);
}

TEST(Springs, SixSupportsOnAFlatFloorByHand) {
  const World world = placed(sprung(six(0.03)));
  const double even = kWeight_n / 6, more = kWeight_n * 0.03 / (4 * 0.25);
  EXPECT_NEAR(world.loads().wheel_n[0], even, kStatic * even);
  EXPECT_NEAR(world.loads().caster_n[1], even + more, kStatic * even);
  EXPECT_NEAR(world.loads().caster_n[2], even - more, kStatic * even);
}

// A floor of one ripple, a cos(pi y / 0.17), has its wheels at y = +-0.17 in hollows of depth a, and its casters at y =
// 0 on crests of height a, all level. The robot stays where it is; each support's spring and tyre, one after the other,
// give by a.
Floor warped(double a_m) {
  Floor floor;
  floor.ripples = {{a_m, 0, M_PI / 0.17, 0}};
  return floor;
}

TEST(Springs, WarpedFloorByHand) {
  const double a_m = 0.002;
  const RobotModel robot = sprung(four());
  const World world = placed(robot, warped(a_m));
  const double even = kWeight_n / 4;
  const double spring = even / 0.010, tyre = even / PhysicsOptions{}.softness.static_sink_m;
  const double change = a_m / (1 / spring + 1 / tyre);
  EXPECT_NEAR(world.loads().wheel_n[0], even - change, kStatic * even);
  EXPECT_NEAR(world.loads().wheel_n[1], even - change, kStatic * even);
  EXPECT_NEAR(world.loads().caster_n[0], even + change, kStatic * even);
  EXPECT_NEAR(world.spring_up_m(0), -change / spring, 1e-7);
  EXPECT_THROW(placed(four(), warped(a_m)), InputError) << "rigid, its wheels hang in the hollows";
}

// Deeper than the springs reach down, 10 mm: the wheels hang at their lower stops, and the casters carry the robot on
// one line. It does not stand.
TEST(Springs, HollowsBeyondTheTravel) { EXPECT_THROW(placed(sprung(four()), warped(0.02)), InputError); }

// Speeding up at a shifts m a h + sum J a / R, by equal springs half to each caster's arm.
TEST(Springs, SpeedingUpShiftsTheLoadByHand) {
  const RobotModel robot = sprung(four());
  World world = placed(robot);
  const double a = 0.5, R = 0.075;
  for (int i = 1; i <= 100; ++i) drive(world, a * 0.02 * i / R, a * 0.02 * i / R, 0.02);
  const double moment = a * (42 * R + 40 * robot.base.com_m.z() + 2 * robot.wheels[0].spin_inertia_kgm2 / R);
  const double shift = moment / (2 * 0.25), even = kWeight_n / 4;
  // The base leans, and its centre of mass goes back with it: of the shift at most W h over the stiffness against it.
  const double kPitched = kWeight_n * (R + 40 * robot.base.com_m.z() / 42) / (2 * even / 0.010 * 0.25 * 0.25);
  EXPECT_NEAR(world.loads().caster_n[0], even - shift, kPitched * shift);
  EXPECT_NEAR(world.loads().caster_n[1], even + shift, kPitched * shift);
  EXPECT_NEAR(world.loads().wheel_n[0], even, kPitched * shift);
}

void expect_rolls_exactly(const RobotModel& robot) {
  const double R = 0.075, b = 0.34;
  World world = placed(robot);
  trip(world, 3, 3, 5);
  const Pose2 ahead = world.pose();
  EXPECT_NEAR(ahead.x_m, R * world.wheel_angle(0), kExact_m);
  EXPECT_NEAR(ahead.y_m, 0, kExact_m);
  trip(world, -1, 1, 2);
  EXPECT_NEAR(world.pose().theta_rad, R * (world.wheel_angle(1) - world.wheel_angle(0)) / b, kExact_m);
  // While the turn speeds up, in a second to w, the centre of mass is x ahead of its axis: m x w h rolls the base on
  // its springs, and carries the axle's middle by R times as much off the wheels' contacts, about which it turns by w
  // / 2.
  const Inertial body = whole_body(robot);
  const double w = 2 * R / b, height_m = R + body.com_m.z();
  double stiffness = 0;
  for (const Wheel& wheel : robot.wheels) stiffness += wheel.suspension.stiffness_npm * b * b / 4;
  for (const Caster& c : robot.casters) stiffness += c.suspension.stiffness_npm * std::pow(c.centre_m.y(), 2);
  const double rolled_m = R * body.mass_kg * body.com_m.x() * w * height_m / stiffness * w / 2;
  EXPECT_LT(rolled_m, 2e-6);
  EXPECT_NEAR(world.pose().x_m, ahead.x_m, kExact_m + rolled_m);
  EXPECT_NEAR(world.pose().y_m, ahead.y_m, kExact_m + rolled_m);
  EXPECT_EQ(world.cost().solver_fallbacks, 0);
}

TEST(Springs, RollsAsExactlyAsRigidSupports) {
  expect_rolls_exactly(sprung(four(0.02)));
  expect_rolls_exactly(sprung(six(0.02)));
  expect_rolls_exactly(sprung(four(), {0.03, 0.0}));
}

// Slowly, and as fast as the course.
TEST(Springs, CableTurnsItAsTheClosedFormSays) {
  const double r = 0.005, R = 0.075, b = 0.34;
  const double closed_rad = (2 * (R + r) * std::acos((R - r) / (R + r)) - 4 * std::sqrt(R * r)) / b;
  const RobotModel narrow = on_sprung_balls({{0.25, 0.08}, {0.25, -0.08}, {-0.25, 0.08}, {-0.25, -0.08}});  // past the cable
  for (const RobotModel& robot : {sprung(four()), sprung(narrow)}) {
    for (const double speed_mps : {0.05, 0.2}) {
      SCOPED_TRACE(::testing::PrintToString(robot.casters.size()) + " casters at " + std::to_string(speed_mps));
      World world = placed(robot);
      Cable cable;
      cable.x_m = 0.15;
      cable.y_m = 0.17;
      world.lay_cable(cable);
      const double command = speed_mps / R;
      for (int i = 1; i <= 50; ++i) drive(world, command * i / 50, command * i / 50, 0.02);
      drive(world, command, command, 0.3 / speed_mps);
      drive(world, 0, 0, 0.5);
      EXPECT_GT(world.pose().x_m, 0.25) << "it has crossed";
      const double odometry_rad = R * (world.wheel_angle(1) - world.wheel_angle(0)) / b;
      EXPECT_NEAR(world.pose().theta_rad - odometry_rad, closed_rad, kCable * closed_rad);
    }
  }
}

TEST(Springs, WheelWithoutLoadIsCounted) {
  Floor floor = warped(0.004);
  floor.ripples[0].kx_radpm = 2;  // deeper and shallower on the way
  const World rigid_start = placed(sprung(four()), floor);
  World world = placed(sprung(four(), {0.002, 0.002}), warped(0.0004));
  drive(world, 2, 2, 1);
  const WheelStrain s = world.strain(0);
  EXPECT_GT(s.least_n, 0);
  EXPECT_GT(s.mean_n, s.least_n);
  EXPECT_EQ(s.unloaded_s, 0);
  EXPECT_GT(rigid_start.loads().wheel_n[0], 0);
}

TEST(Springs, GoOnFromASnapshot) {
  const RobotModel robot = sprung(four());
  const Floor floor = warped(0.001);
  World a = placed(robot, floor);
  drive(a, 2, 2.2, 0.5);
  const Snapshot then = a.snapshot();
  World b = placed(robot, floor);
  b.resume(then, {});
  drive(a, 2, 2, 0.5);
  drive(b, 2, 2, 0.5);
  EXPECT_EQ(a.pose().x_m, b.pose().x_m);
  EXPECT_EQ(a.pose().theta_rad, b.pose().theta_rad);
}

}  // namespace
}  // namespace umbsim
