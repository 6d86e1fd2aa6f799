// What a robot stands before it tips over: the balance of moments by hand, and by driving just below and just above it.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/sim/rolling_robot.h"

namespace umbsim {
namespace {

using testing::kG;
using testing::labmate;
using testing::placed;

// The settled robot has sunk by 0.1 mm into its supports.
constexpr double kSunk = 2e-3;

// Moments about the wheels' contacts: m g x = (m h + sum J / R) a, with x and h of the centre of mass of the whole.
struct ByHand {
  double mass_kg = 0, ahead_m = 0, height_m = 0, spin_kgm = 0;
  explicit ByHand(const RobotModel& r) {
    mass_kg = r.base.mass_kg + r.wheels[0].mass_kg + r.wheels[1].mass_kg;
    ahead_m = r.base.mass_kg * r.base.com_m.x() / mass_kg;
    height_m = r.wheels[0].radius_m + r.base.mass_kg * r.base.com_m.z() / mass_kg;
    spin_kgm = 2 * r.wheels[0].spin_inertia_kgm2 / r.wheels[0].radius_m;
  }
  double speeding_up_mps2() const { return mass_kg * kG * ahead_m / (mass_kg * height_m + spin_kgm); }
  double slowing_down_mps2(double caster_m) const {
    return mass_kg * kG * (caster_m - ahead_m) / (mass_kg * height_m + spin_kgm);
  }
};

FloorMotion forward(double mps2) {
  FloorMotion m;
  m.forward_mps2 = mps2;
  return m;
}

TEST(Standing, ForwardsAndBackwardsAsByHand) {
  const RobotModel robot = labmate();
  const World world = placed(robot);
  const Standing s = world.standing();
  const ByHand hand(robot);
  EXPECT_NEAR(s.largest_share(forward(1)), hand.speeding_up_mps2(), kSunk * hand.speeding_up_mps2());
  EXPECT_NEAR(s.largest_share(forward(-1)), hand.slowing_down_mps2(0.25), kSunk * hand.slowing_down_mps2(0.25));
}

// To the left the line from the right wheel to the caster is the edge: half the wheelbase times cosine and so on. Here
// from the moments of weight and inertia about the line, written out.
TEST(Standing, SidewaysAboutTheLineFromWheelToCaster) {
  const RobotModel robot = labmate();
  const World world = placed(robot);
  const Standing s = world.standing();
  const ByHand hand(robot);
  const double b2 = robot.wheelbase_m() / 2, caster_m = 0.25;
  const double line_m = std::hypot(b2, caster_m);
  const double inside_m = b2 * (caster_m - hand.ahead_m) / line_m;  // of the centre of mass from the line
  const double share = caster_m / line_m;                           // of a sideways acceleration across the line
  // Wheels that spin are gyroscopes: rolling on an arc to the left they press to the right, too.
  FloorMotion left;
  left.left_mps2 = 1;
  const double by_hand = hand.mass_kg * kG * inside_m / (share * (hand.mass_kg * hand.height_m + hand.spin_kgm));
  EXPECT_NEAR(s.largest_share(left), by_hand, kSunk * by_hand);
}

// Turning in place moves a centre of mass that is ahead of the axle sideways, and pulls it back: both by hand.
TEST(Standing, TurningInPlaceMovesTheCentreOfMass) {
  RobotModel robot = labmate();
  robot.base.inertia_kgm2(0, 2) = robot.base.inertia_kgm2(2, 0) = 0;
  const World world = placed(robot);
  const Standing s = world.standing();
  const ByHand hand(robot);
  FloorMotion spin;
  spin.turning_speed2_radps2 = 1;
  // The pull backwards is an acceleration of -x omega^2, and the spinning wheels give nothing: they turn oppositely.
  // The products of inertia of the whole do: its parts lie at different heights.
  const double x = hand.ahead_m, z = hand.height_m - robot.wheels[0].radius_m;
  const double m = robot.base.mass_kg, M = hand.mass_kg;
  const double Ixz = -(m * (robot.base.com_m.x() - x) * (robot.base.com_m.z() - z) + (M - m) * x * z);
  const double by_hand = M * kG * (0.25 - x) / (M * x * hand.height_m - Ixz);
  EXPECT_NEAR(s.largest_share(spin), by_hand, kSunk * by_hand);
  // A robot that already turns faster than that does not stand whatever is added.
  spin.turning_speed2_radps2 = 1.01 * by_hand;
  EXPECT_EQ(s.largest_share(forward(1), spin), 0);
}

// Ramps of this acceleration, as a driver's: 20 ms periods.
void speed_up(World& world, double mps2, double from_mps, double seconds) {
  const double R = 0.075;
  const int periods = int(std::lround(seconds / 0.02));
  for (int i = 1; i <= periods; ++i) {
    const double radps = (from_mps + mps2 * i * 0.02) / R;
    world.command(radps, radps);
    world.advance(0.02);
  }
}

constexpr double kDrive_s = 0.6;  // longer than a moment
constexpr double kNear = 0.02;

TEST(TippingOver, SpeedingUpJustBelowAndJustAbove) {
  const double limit = ByHand(labmate()).speeding_up_mps2();
  World below = placed(labmate());
  EXPECT_NO_THROW(speed_up(below, (1 - kNear) * limit, 0, kDrive_s));
  World above = placed(labmate());
  try {
    speed_up(above, (1 + kNear) * limit, 0, kDrive_s);
    FAIL() << "it still stands";
  } catch (const TippedOver& e) {
    EXPECT_EQ(e.fall.way, "backwards");
    EXPECT_EQ(e.fall.lifted, "caster ball");
    EXPECT_LT(e.fall.stood_s, 0.1);
  }
}

// With the caster behind. Braked wheels ahead of a caster have no load left, and no grip, before a robot tips over it.
TEST(TippingOver, SlowingDownJustBelowAndJustAbove) {
  RobotModel robot = labmate();
  const double limit = ByHand(robot).speeding_up_mps2();
  robot.base.com_m.x() *= -1;
  robot.casters[0].centre_m.x() *= -1;
  for (const double share : {1 - kNear, 1 + kNear}) {
    World world = placed(robot);
    const double top_mps = limit * kDrive_s;
    speed_up(world, top_mps / 8, 0, 8);
    try {
      speed_up(world, -share * limit, top_mps, kDrive_s);
      EXPECT_LT(share, 1) << "it still stands";
    } catch (const TippedOver& e) {
      EXPECT_GT(share, 1) << e.what();
      EXPECT_EQ(e.fall.way, "forwards");
    }
  }
}

// A robot that was recorded came down again. Driven as it was it leans for longer than a moment, and comes down, too;
// where it goes on speeding up it falls all the same.
TEST(TippingOver, ALeanThatEndsIsNoFallWhereItMayLean) {
  PhysicsOptions may;
  may.may_lean = true;
  const double limit = ByHand(labmate()).speeding_up_mps2();
  constexpr double kLong_s = 0.4, kAbove = 1.02;
  World strict = placed(labmate());
  EXPECT_THROW(speed_up(strict, kAbove * limit, 0, kLong_s), TippedOver);
  World world(labmate(), {20.0}, {}, may);
  world.place({});
  speed_up(world, kAbove * limit, 0, kLong_s);
  EXPECT_EQ(world.loads().caster_n[0], 0) << "else this shows nothing";
  speed_up(world, 0, kAbove * limit * kLong_s, 1);
  EXPECT_GT(world.loads().caster_n[0], 0);
  World further(labmate(), {20.0}, {}, may);
  further.place({});
  try {
    speed_up(further, 1.5 * limit, 0, 2);
    FAIL() << "it still stands";
  } catch (const TippedOver& e) {
    EXPECT_GE(e.fall.tilt_rad, kTippedOver_rad);
  }
}

// What lifts a support for a moment is no fall: a cable under a fast wheel, and a push that lifts one side.
TEST(TippingOver, HopsAreNone) {
  Floor floor;
  Cable cable;
  cable.x_m = 1;
  cable.y_m = -0.17;
  cable.height_m = 0.02;
  floor.cables.push_back(cable);
  World world = placed(labmate(), floor);
  EXPECT_NO_THROW(speed_up(world, 0.5, 0, 2));
  EXPECT_NO_THROW(speed_up(world, 0, 1, 1));
  EXPECT_GT(world.pose().x_m, 1.5);
}

TEST(TippingOver, APushThatLiftsAWheelIsNone) {
  const Push push{0.1, 0.1, 22, M_PI / 2, 0.05, 0.3};
  World world(labmate(), {20.0}, {}, {}, {push});
  world.place({});
  bool lifted = false;
  EXPECT_NO_THROW({
    for (int i = 0; i < 100; ++i) {
      world.advance(0.02);
      lifted = lifted || world.loads().wheel_n[1] == 0;
    }
  });
  EXPECT_TRUE(lifted);
}

// Casters ahead and behind: on a floor that is not even one of them always hangs.
TEST(TippingOver, ACasterThatHangsIsNone) {
  RobotModel robot = labmate();
  robot.base.com_m.x() = 0.05;
  robot.casters.push_back(robot.casters[0]);
  robot.casters[1].link = "behind";
  robot.casters[1].centre_m.x() = -0.25;
  robot.casters[1].centre_m.z() += 0.005;
  World world = placed(robot);
  bool hung = false;
  EXPECT_NO_THROW({
    speed_up(world, 0.2, 0, 1);
    for (int i = 0; i < 250; ++i) {
      speed_up(world, 0, 0.2, 0.02);
      hung = hung || world.loads().caster_n[1] == 0;
    }
  });
  EXPECT_TRUE(hung);
}

}  // namespace
}  // namespace umbsim
