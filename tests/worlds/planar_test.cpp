// The vehicle model of the plane against what mechanics says of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bench/worlds/checks/robots.h"
#include "bench/worlds/engines/planar/robot.h"
#include "effects/contact.h"
#include "effects/geometry.h"

namespace umbsim::worlds::planar {
namespace {

constexpr double kPeriod_s = 0.02;
constexpr double kGravity_mps2 = 9.81;

using Watch = std::function<void(const PlanarRobot&)>;

// From rest up to these wheel speeds, along, and back to rest.
void drive(PlanarRobot& robot, double left_radps, double right_radps, double along_s, const Watch& watch = {}) {
  constexpr double kRamp_s = 1;
  for (double t = kPeriod_s; t < along_s + 2 * kRamp_s + 0.3; t += kPeriod_s) {
    const double share = std::clamp(std::min(t, along_s + 2 * kRamp_s - t) / kRamp_s, 0.0, 1.0);
    robot.advance({share * left_radps, share * right_radps}, kPeriod_s);
    if (watch) watch(robot);
  }
}

TEST(PlanarRobot, UnequalRadiiDriveAnArc) {
  Rig rig = plain_rig(Size::middle);
  apply(WheelRadiusDifference{0.01}, rig);
  PlanarRobot robot(rig, {}, {});
  drive(robot, 3, 3, 8);
  const double left_m = robot.wheel_angle(0) * rig.robot.wheels[0].radius_m;
  const double right_m = robot.wheel_angle(1) * rig.robot.wheels[1].radius_m;
  const Pose2 expected = arc((left_m + right_m) / 2, (right_m - left_m) / rig.robot.wheelbase_m());
  constexpr double kCreep = 0.002;  // share: centripetal force on creeping tyres
  EXPECT_NEAR(robot.pose().theta_rad, expected.theta_rad, kCreep * expected.theta_rad);
  EXPECT_NEAR(robot.pose().y_m, expected.y_m, 2 * kCreep * expected.y_m);
  EXPECT_NEAR(robot.pose().x_m, expected.x_m, 1e-4);
}

// Equal toe of both wheels: the robot goes where the wheels point.
TEST(PlanarRobot, ToeCreepsSideways) {
  Rig rig = plain_rig(Size::middle);
  apply(WheelMisalignment{0.01, 0.01}, rig);
  PlanarRobot robot(rig, {}, {});
  drive(robot, 3, 3, 8);
  EXPECT_NEAR(robot.pose().y_m, 0.01 * robot.pose().x_m, 0.02 * 0.01 * robot.pose().x_m);
}

// Slip across = creep * force / load, with the force of the slope on the wheels; nothing holds the balls.
TEST(PlanarRobot, SlopeDriftsWithTheCreep) {
  for (const TyreLaw::Curve curve : {TyreLaw::Curve::brush, TyreLaw::Curve::lugre}) {
    Rig rig = plain_rig(Size::middle);
    rig.robot.base.com_m.x() = 0;  // no turning towards the valley
    Caster behind = rig.robot.casters[0];
    behind.centre_m.x() *= -1;
    rig.robot.casters.push_back(behind);
    rig.floor.slope_rad = 0.02;
    rig.floor.downhill_rad = M_PI / 2;
    PlanarOptions options;
    options.curve = curve;
    options.creep = 0.01;
    PlanarRobot robot(rig, options, {});
    drive(robot, 3, 3, 8);
    const double ratio =
        rig.robot.total_mass_kg() * kGravity_mps2 * std::sin(0.02) / (robot.load_n(0) + robot.load_n(1));
    const double used = ratio / rig.floor.friction;
    const double law = curve == TyreLaw::Curve::lugre ? 1 / (1 - used) : 3 * (1 - std::cbrt(1 - used)) / used;
    const double expected = 0.01 * ratio * law * robot.pose().x_m;
    EXPECT_NEAR(robot.pose().y_m, expected, 0.03 * expected);
  }
}

TEST(PlanarRobot, WithoutGripAPushIsMomentum) {
  Rig rig = plain_rig(Size::middle);
  rig.floor.friction = 0;
  PlanarRobot robot(rig, {}, {});
  Pull pull;
  pull.force_y_n = 50;
  pull.ahead_m = 0.1;
  robot.set_pull(pull);
  robot.advance({0, 0}, 0.2);
  EXPECT_NEAR(robot.momentum_ns(), 10, 1e-9);
}

// Pushed until it slides: kinetic and spring energy only fall once the push is over, and no tyre holds more than its
// friction.
TEST(PlanarRobot, FrictionTakesEnergyAndHasALimit) {
  for (const TyreLaw::Curve curve : {TyreLaw::Curve::brush, TyreLaw::Curve::lugre}) {
    Rig rig = plain_rig(Size::middle);
    rig.floor.friction = 0.3;
    rig.drivetrain = Drivetrain(0);  // the wheels run free
    PlanarOptions options;
    options.curve = curve;
    options.load_time_s = 1e6;  // loads stay, so that a tread's spring keeps its energy
    PlanarRobot robot(rig, options, {});
    Pull pull;
    pull.force_x_n = 100;
    pull.force_y_n = 250;
    pull.ahead_m = 0.15;
    robot.set_pull(pull);
    robot.advance({0, 0}, 0.3);
    robot.set_pull({});
    robot.advance({0, 0}, 1e-4);
    double before_j = robot.energy_j(), most_grip = 0;
    EXPECT_GT(before_j, 1);
    for (int k = 0; k < 20000; ++k) {
      robot.advance({0, 0}, 1e-4);
      EXPECT_LE(robot.energy_j(), before_j * (1 + 1e-4) + 1e-9) << k;
      before_j = robot.energy_j();
      for (int i = 0; i < 2; ++i) most_grip = std::max(most_grip, robot.grip_used(i));
    }
    EXPECT_LE(most_grip, 1 + 1e-9);
    EXPECT_GT(most_grip, 0.99);  // it did slide
  }
}

// A round cable under the right wheel: the heading by which the wheel's longer way turns the robot.
TEST(PlanarRobot, CableTurnsByItsClosedForm) {
  for (const double height_m : {0.004, 0.01}) {
    Rig rig = plain_rig(Size::middle);
    const double R = 0.075, r = height_m / 2, b = rig.robot.wheelbase_m();
    rig.floor.cables.push_back({0.6, -b / 2, M_PI / 2, height_m, 0.1});
    PlanarRobot robot(rig, {}, {});
    drive(robot, 2, 2, 8);
    const double psi = std::acos((R - r) / (R + r));
    const double longer_m = 2 * (R + r) * psi - 4 * std::sqrt(R * r);
    const double turned_by_counts = (robot.wheel_angle(1) - robot.wheel_angle(0)) * R / b;
    EXPECT_NEAR(robot.pose().theta_rad - turned_by_counts, -longer_m / b, 0.05 * longer_m / b);
  }
}

// Loads on three supports are their statics, in a curve too.
TEST(PlanarRobot, LoadsAreStaticsAndTransfer) {
  const Rig rig = plain_rig(Size::middle);
  PlanarRobot robot(rig, {}, {});
  const double mass_kg = rig.robot.total_mass_kg(), com_m = rig.robot.base.com_m.x() * rig.robot.base.mass_kg / mass_kg;
  const double wheels_n = mass_kg * kGravity_mps2 * (1 - com_m / rig.robot.casters[0].centre_m.x());
  EXPECT_NEAR(robot.load_n(0), wheels_n / 2, 0.01 * wheels_n);
  double most_n = 0;
  drive(robot, 6, 9, 3, [&](const PlanarRobot& r) { most_n = std::max(most_n, r.load_n(1) - r.load_n(0)); });
  const double v = 7.5 * 0.075, w = 3 * 0.075 / rig.robot.wheelbase_m();
  const double height_m = (rig.robot.base.mass_kg * (rig.robot.base.com_m.z() + 0.075) + 2 * 0.075) / mass_kg;
  EXPECT_NEAR(most_n, 2 * mass_kg * v * w * height_m / rig.robot.wheelbase_m(), 0.1 * most_n);
}

// A patch of width w that turns on the spot takes w^2 / (2 b^2) of the turn: docs/effects.md.
TEST(PlanarRobot, PatchResistsTurningOnTheSpot) {
  const auto turned = [](double width_m) {
    Rig rig = plain_rig(Size::middle);
    apply(ContactPatch{width_m}, rig);
    PlanarRobot robot(rig, {}, {});
    drive(robot, -1.5, 1.5, 2);
    const double by_counts = (robot.wheel_angle(1) - robot.wheel_angle(0)) * 0.075 / rig.robot.wheelbase_m();
    return robot.pose().theta_rad / by_counts - 1;
  };
  const double lost = turned(0) - turned(0.03);
  EXPECT_NEAR(lost, 0.03 * 0.03 / (2 * 0.34 * 0.34), 0.0004);
}

Pose2 end_of_a_rough_drive(double step_share, TyreLaw::Curve curve) {
  Rig rig = plain_rig(Size::middle);
  apply(WheelMisalignment{0.005, -0.003}, rig);
  apply(ContactPatch{0.02}, rig);
  rig.floor.cables.push_back({0.5, -0.17, M_PI / 2, 0.006, 0.1});
  rig.drivetrain.motor[0].backlash_rad = 0.02;
  PlanarOptions options;
  options.step_share = step_share;
  options.curve = curve;
  PlanarRobot robot(rig, options, {});
  drive(robot, 3, 3, 4);
  drive(robot, -1, 1, 2);
  return robot.pose();
}

TEST(PlanarRobot, HalfTheStepChangesLittle) {
  for (const TyreLaw::Curve curve : {TyreLaw::Curve::brush, TyreLaw::Curve::lugre}) {
    const Pose2 full = end_of_a_rough_drive(1, curve), half = end_of_a_rough_drive(0.5, curve);
    const double change_m = std::hypot(full.x_m - half.x_m, full.y_m - half.y_m);
    EXPECT_LT(change_m, 1e-4);
    EXPECT_LT(std::abs(full.theta_rad - half.theta_rad), 1e-4);
  }
}

TEST(PlanarRobot, SameBytesTwice) {
  const Pose2 once = end_of_a_rough_drive(1, TyreLaw::Curve::brush),
              again = end_of_a_rough_drive(1, TyreLaw::Curve::brush);
  EXPECT_EQ(once.x_m, again.x_m);
  EXPECT_EQ(once.y_m, again.y_m);
  EXPECT_EQ(once.theta_rad, again.theta_rad);
}

TEST(PlanarRobot, PlayIsLostAtAReversal) {
  Rig rig = plain_rig(Size::middle);
  rig.drivetrain.motor[1].backlash_rad = 0.04;
  PlanarRobot robot(rig, {}, {});
  drive(robot, 3, 3, 1);
  drive(robot, -3, -3, 1);
  double least = 1, most = -1;
  drive(robot, 3, 3, 1, [&](const PlanarRobot& r) {
    least = std::min(least, r.encoder_angle(1) - r.wheel_angle(1));
    most = std::max(most, r.encoder_angle(1) - r.wheel_angle(1));
  });
  EXPECT_NEAR(most - least, 0.04, 1e-6);
}

}  // namespace
}  // namespace umbsim::worlds::planar
