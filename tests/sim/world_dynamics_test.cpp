// Forces: torque limits, friction limits and energy, against equations of motion written out here.
#include <gtest/gtest.h>

#include <iostream>

#include "tests/sim/rolling_robot.h"

namespace umbsim {
namespace {

using testing::drive;
using testing::kG;
using testing::labmate;
using testing::placed;
using testing::rigid;

constexpr double kBase_kg = 40, kRobot_kg = 42;
constexpr double kComAhead_m = 0.06, kBallAhead_m = 0.25;
constexpr double kR_m = 0.075;
constexpr double kComHeight_m = kR_m + 0.05;
constexpr double kSpin_kgm2 = 2 * kR_m * kR_m / 2;  // both wheels

// Steady motion of rigid bodies: what is left is round-off and the contacts' creep of 1e-9 m/s per newton.
constexpr double kSteady = 1e-6;

// Difference of the mean speeds of two control periods.
double forward_acceleration(World& world, double command_radps, double seconds) {
  const auto speed = [&] {
    const double x_m = world.pose().x_m;
    drive(world, command_radps, command_radps, 0.02);
    return (world.pose().x_m - x_m) / 0.02;
  };
  const double first = speed();
  drive(world, command_radps, command_radps, seconds - 0.02);
  return (speed() - first) / seconds;
}

// Both motors at their limit, no slip: 2 tau = R F + 2 I a / R and F = m a.
TEST(WorldDynamics, TorqueLimitsTheAcceleration) {
  for (const double tau_nm : {0.3, 1.0, 2.0}) {
    World world = placed(labmate(), {}, rigid(), tau_nm);
    drive(world, 100, 100, 0.1);
    const double measured = forward_acceleration(world, 100, 0.5);
    const double expected = 2 * tau_nm / (kR_m * (kRobot_kg + kSpin_kgm2 / (kR_m * kR_m)));
    EXPECT_NEAR(measured, expected, kSteady * expected);
    std::cout << "torque " << tau_nm << " N m: " << measured << " m/s2 (" << expected << ")\n";
  }
}

// Wheels that slip push with mu N. Moments about the ground below the axle (pitch positive nose down), with the ball's
// load Nb: m_base g x_com - Nb x_ball = m_base H a + m_wheels R a + I alpha, and m a = mu (m g - Nb); friction < 0
// stands for braking. The wheels' I alpha = s0 + s1 Nb is either known or 2 tau - mu (m g - Nb) R. Linear in Nb.
double slipping_acceleration(double friction, double s0, double s1 = 0) {
  const double mass_height = kBase_kg * kComHeight_m + 2 * kR_m;
  const double c0 = friction * kG, c1 = friction / kRobot_kg;  // a = c0 - c1 Nb
  const double Nb = (kBase_kg * kG * kComAhead_m - mass_height * c0 - s0) / (kBallAhead_m - mass_height * c1 + s1);
  return c0 - c1 * Nb;
}

Floor slippery() {
  Floor floor;
  floor.friction = 0.2;
  return floor;
}

TEST(WorldDynamics, SpinningWheelsPushWithFrictionTimesLoad) {
  const double tau_nm = 4;
  World world = placed(labmate(), slippery(), rigid(), tau_nm);
  drive(world, 1e4, 1e4, 0.1);
  const double measured = forward_acceleration(world, 1e4, 0.4);
  const double expected = slipping_acceleration(0.2, 2 * tau_nm - 0.2 * kRobot_kg * kG * kR_m, 0.2 * kR_m);
  EXPECT_NEAR(measured, expected, kSteady * expected);
  EXPECT_GT(world.wheel_speed(0) * kR_m, 2 * expected * 0.5) << "the wheels spin";
  EXPECT_EQ(world.cost().solver_fallbacks, 0);
  EXPECT_NEAR(world.pose().y_m, 0, 1e-9);
  std::cout << "wheel spin: " << measured << " m/s2 (" << expected << ")\n";
}

// Motors strong enough to follow a command of 4 m/s2, which is more than mu g.
TEST(WorldDynamics, CommandBeyondTheFrictionLimitSlips) {
  constexpr double kCommand_mps2 = 4;
  World world = placed(labmate(), slippery(), rigid(), 20);
  double t_s = 0, x_m[3];
  for (double& x : x_m) {
    for (int i = 0; i < 10; ++i) {
      t_s += 0.02;
      drive(world, kCommand_mps2 * t_s / kR_m, kCommand_mps2 * t_s / kR_m, 0.02);
    }
    x = world.pose().x_m;
  }
  const double measured = (x_m[2] - 2 * x_m[1] + x_m[0]) / (0.2 * 0.2);
  const double expected = slipping_acceleration(0.2, kSpin_kgm2 * kCommand_mps2 / kR_m);
  EXPECT_NEAR(measured, expected, kSteady * expected);
  EXPECT_NEAR(world.wheel_speed(0) * kR_m, kCommand_mps2 * t_s, kSteady) << "the wheels follow the command";
  std::cout << "commanded 4 m/s2: " << measured << " m/s2 (" << expected << ")\n";
}

TEST(WorldDynamics, LockedWheelsBrakeWithFrictionTimesLoad) {
  World world = placed(labmate(), slippery(), rigid(), 200);
  for (int i = 1; i <= 100; ++i) drive(world, 0.3 * i, 0.3 * i, 0.02);  // to 2.25 m/s at 1.1 m/s2
  drive(world, 0, 0, 0.1);
  const double measured = forward_acceleration(world, 0, 0.5);
  EXPECT_NEAR(world.wheel_speed(0), 0, 1e-9) << "locked";
  const double expected = slipping_acceleration(-0.2, 0);
  EXPECT_NEAR(measured, expected, kSteady * -expected);
  EXPECT_EQ(world.cost().solver_fallbacks, 0);
  std::cout << "locked wheels: " << measured << " m/s2 (" << expected << ")\n";
}

TEST(WorldDynamics, SoftContactsAccelerateLikeRigidOnes) {
  // The floor contact's sink shifts by fractions of 0.1 mm when the load shifts: a pitch of the base, and no more.
  constexpr double kPitching = 1e-3;
  World world = placed(labmate(), {}, {}, 1.0);
  drive(world, 100, 100, 0.3);
  const double measured = forward_acceleration(world, 100, 0.5);
  const double expected = 2 * 1.0 / (kR_m * (kRobot_kg + kSpin_kgm2 / (kR_m * kR_m)));
  EXPECT_NEAR(measured, expected, kPitching * expected);
}

TEST(WorldDynamics, BrakingNeverGainsEnergy) {
  for (const double friction : {0.9, 0.1}) {  // rolling to a stop, and sliding
    Floor floor;
    floor.friction = friction;
    World world = placed(labmate(), floor, rigid(), 2);
    for (int i = 1; i <= 200; ++i) drive(world, 0.05 * i, 0.045 * i, 0.02);
    world.command(0, 0);
    world.advance(0.01);
    double energy = world.energy(), largest_gain = 0;
    const double moving = energy;
    for (int i = 0; i < 400; ++i) {
      world.command(0, 0);
      world.advance(0.01);
      largest_gain = std::max(largest_gain, world.energy() - energy);
      energy = world.energy();
    }
    constexpr double kRoundOff_j = 1e-9;
    EXPECT_LE(largest_gain, kRoundOff_j) << "friction " << friction;
    EXPECT_GT(moving - energy, 42 * 0.7 * 0.7 / 2) << "it had been moving at 0.71 m/s";
    std::cout << "braking, friction " << friction << ": from " << moving << " to " << energy
              << " J, largest gain in a step " << largest_gain << " J\n";
  }
}

double spin_up_distance(double step_s) {
  PhysicsOptions options;
  options.step_s = step_s;
  World world = placed(labmate(), {}, options, 1.5);
  drive(world, 12, 9, 2);
  drive(world, 0, 0, 3);
  return world.pose().x_m;
}

// With torque limits at work the integrator is of first order.
TEST(WorldDynamics, HalvingTheStepHalvesTheError) {
  const double reference_m = spin_up_distance(0.02 / 256);
  double last = 0;
  for (const double step_s : {0.010, 0.005, 0.0025, 0.00125}) {
    const double error_m = std::abs(spin_up_distance(step_s) - reference_m);
    std::cout << "step " << step_s << " s: error " << error_m << " m" << (last > 0 ? ", ratio " : "")
              << (last > 0 ? std::to_string(last / error_m) : "") << "\n";
    if (last > 0) {
      EXPECT_GT(last / error_m, 1.5);
    }
    last = error_m;
  }
}

}  // namespace
}  // namespace umbsim
