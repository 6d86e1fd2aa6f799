// A swivelling caster: it trails, and shows it by where it carries its load.
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
using testing::trip;

constexpr double kSwivel_m = -0.25, kTrail_m = 0.03;
constexpr double kFork_kg = 0.2, kCasterWheel_kg = 0.3;

// The centre of mass behind the axle, the caster behind that. Built trailing for a drive forward.
RobotModel robot_with_swivel_caster() {
  RobotModel robot = labmate();
  robot.base.com_m.x() = -0.06;
  Caster caster;
  caster.link = "caster_wheel";
  caster.swivels = true;
  caster.radius_m = 0.03;
  caster.swivel_point_m = {kSwivel_m, 0, 0};
  caster.centre_m = {kSwivel_m - kTrail_m, 0, 0.03 - 0.075};
  caster.fork = {kFork_kg, {kSwivel_m - kTrail_m, 0, -0.02}, Eigen::Vector3d(1e-4, 1e-4, 1e-4).asDiagonal()};
  caster.wheel_mass_kg = kCasterWheel_kg;
  caster.wheel_spin_inertia_kgm2 = 0.3 * 0.03 * 0.03 / 2;
  caster.wheel_transverse_inertia_kgm2 = 0.3 * 0.03 * 0.03 / 4;
  robot.casters = {caster};
  return robot;
}

// Moments about the axle, for a caster that points away from or towards it: the fork and its wheel stand above the
// contact point.
double caster_load(double reach_m) { return 40 * kG * 0.06 / reach_m + (kFork_kg + kCasterWheel_kg) * kG; }

TEST(WorldCaster, TrailsInBothDirections) {
  constexpr double kSettled = 1e-7;  // the swivel angle dies out with e^(-2 m / 0.03 m); contacts are rigid
  World world = placed(robot_with_swivel_caster(), {}, rigid());
  EXPECT_NEAR(world.loads().caster_n[0], caster_load(0.28), kSettled * caster_load(0.28));
  trip(world, 2, 2.2, 4);  // a curve, so that the caster does not stand on the fence when reversed
  trip(world, -3, -3, 8);
  EXPECT_NEAR(world.loads().caster_n[0], caster_load(0.22), kSettled * caster_load(0.22)) << "it has turned round";
  std::cout << "caster load backward " << world.loads().caster_n[0] << " N (" << caster_load(0.22) << ")\n";
  trip(world, 2, 2.2, 2);
  trip(world, 3, 3, 8);
  EXPECT_NEAR(world.loads().caster_n[0], caster_load(0.28), kSettled * caster_load(0.28)) << "and back";
  std::cout << "caster load forward " << world.loads().caster_n[0] << " N (" << caster_load(0.28) << ")\n";
  EXPECT_EQ(world.cost().solver_fallbacks, 0);
}

TEST(WorldCaster, TrailingCasterDrivesStraight) {
  constexpr double kStraight = 1e-9;
  World world = placed(robot_with_swivel_caster());
  trip(world, 3, 3, 5);
  EXPECT_NEAR(world.pose().y_m, 0, kStraight);
  EXPECT_NEAR(world.pose().theta_rad, 0, kStraight);
  EXPECT_NEAR(world.pose().x_m, 0.075 * world.wheel_angle(0), 1e-7);  // contact creep
}

TEST(WorldCaster, MirroredCommandsMirrorThePath) {
  World a = placed(robot_with_swivel_caster()), b = placed(robot_with_swivel_caster());
  trip(a, 2, 3, 4);
  trip(a, -3, -2, 4);
  trip(b, 3, 2, 4);
  trip(b, -2, -3, 4);
  EXPECT_NEAR(a.pose().x_m, b.pose().x_m, 1e-9);
  EXPECT_NEAR(a.pose().y_m, -b.pose().y_m, 1e-9);
  EXPECT_NEAR(a.pose().theta_rad, -b.pose().theta_rad, 1e-9);
}

}  // namespace
}  // namespace umbsim
