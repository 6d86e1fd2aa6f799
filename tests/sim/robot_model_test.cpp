// What load_robot makes of good files. Expected values are worked out here by hand from the numbers in the URDF.
#include "sim/model/robot_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/sim/urdf_text.h"

namespace umbsim {
namespace {

using testing::kRobot;
using testing::loaded;
using testing::part;
using testing::plus;
using testing::with;

constexpr double kRoundOff = 1e-12;
// A file's 1.57 for pi/2 turns a frame by 8e-4 rad; on products of order one that is at most 1e-3 of a length and 1e-6
// (its square) of a moment of inertia.
constexpr double kRpy157_rad = 8e-4;

std::string shipped(const std::string& name) { return std::string(UMBSIM_SOURCE_DIR) + "/robots/" + name; }
std::string example(const std::string& name) { return std::string(UMBSIM_SOURCE_DIR) + "/tests/sim/urdf/" + name; }

TEST(ShippedRobots, LabmateHasTheStatedDimensions) {
  const RobotModel robot = load_robot(shipped("labmate.urdf"));
  EXPECT_EQ(robot.name, "labmate");
  EXPECT_EQ(robot.urdf, "labmate.urdf");
  EXPECT_NEAR(robot.wheelbase_m(), 0.340, kRoundOff);
  EXPECT_NEAR(robot.base.mass_kg, 40, kRoundOff);
  EXPECT_NEAR(robot.total_mass_kg(), 42, kRoundOff);
  EXPECT_TRUE(robot.base.com_m.isApprox(Eigen::Vector3d(0.06, 0, 0.05), kRoundOff));
  EXPECT_TRUE(robot.base.inertia_kgm2.isApprox(Eigen::Vector3d(0.9, 0.9, 1.4).asDiagonal().toDenseMatrix(), kRoundOff));
  for (const Wheel& wheel : robot.wheels) {
    EXPECT_DOUBLE_EQ(wheel.radius_m, 0.075);
    EXPECT_NEAR(wheel.spin_inertia_kgm2, 1 * 0.075 * 0.075 / 2, kRoundOff);
    EXPECT_NEAR(wheel.transverse_inertia_kgm2, 1 * (3 * 0.075 * 0.075 + 0.03 * 0.03) / 12, kRoundOff);
    EXPECT_DOUBLE_EQ(wheel.effort_limit_nm, 20);
  }
  ASSERT_EQ(robot.casters.size(), 1u);
  EXPECT_FALSE(robot.casters[0].swivels);
  EXPECT_DOUBLE_EQ(robot.casters[0].radius_m, 0.03);
  EXPECT_TRUE(robot.casters[0].centre_m.isApprox(Eigen::Vector3d(0.25, 0, 0.030 - 0.075), kRoundOff));
}

TEST(ShippedRobots, OptiodomStandsOnThreePoints) {
  const RobotModel robot = load_robot(shipped("optiodom.urdf"));
  EXPECT_NEAR(robot.wheelbase_m(), 0.200, kRoundOff);
  EXPECT_DOUBLE_EQ(robot.wheels[0].radius_m, 0.042);
  // The file rounds the solid cylinder's moments to seven digits.
  EXPECT_NEAR(robot.wheels[0].transverse_inertia_kgm2, 0.1 * (3 * 0.042 * 0.042 + 0.026 * 0.026) / 12, 1e-11);
  ASSERT_EQ(robot.casters.size(), 1u);
  EXPECT_NEAR(robot.casters[0].centre_m.z() - robot.casters[0].radius_m, -0.042, kRoundOff);
}

TEST(PublishedStyles, BurgerLike) {
  const RobotModel robot = load_robot(example("burger_like.urdf"));
  EXPECT_NEAR(robot.wheelbase_m(), 0.16, kRoundOff);
  EXPECT_EQ(robot.wheels[0].joint, "wheel_left_joint");
  EXPECT_TRUE(robot.wheels[0].axis == Eigen::Vector3d::UnitY());
  EXPECT_NEAR(robot.wheels[0].spin_inertia_kgm2, 2.0e-5, kRoundOff);
  EXPECT_NEAR(robot.wheels[0].transverse_inertia_kgm2, (1.0e-5 + 1.2e-5) / 2, kRoundOff);

  // base_link is 0.023 m below the axle. Two bodies: 0.8 kg at (0.01, 0, 0.05 - 0.023) and 0.2 kg at
  // (-0.03, 0, 0.17 - 0.023); the common centre of mass, then the parallel axis theorem about it.
  EXPECT_NEAR(robot.base.mass_kg, 1.0, kRoundOff);
  const double x = 0.8 * 0.01 + 0.2 * -0.03;
  const double z = 0.8 * 0.027 + 0.2 * 0.147;
  EXPECT_NEAR(robot.base.com_m.x(), x, kRoundOff);
  EXPECT_NEAR(robot.base.com_m.z(), z, kRoundOff);
  const double dx1 = 0.01 - x, dz1 = 0.027 - z, dx2 = -0.03 - x, dz2 = 0.147 - z;
  const Eigen::Matrix3d& inertia = robot.base.inertia_kgm2;
  EXPECT_NEAR(inertia(0, 0), 0.0022 + 0.8 * dz1 * dz1 + 0.001 + 0.2 * dz2 * dz2, kRoundOff);
  EXPECT_NEAR(inertia(1, 1), 0.0021 + 0.8 * (dx1 * dx1 + dz1 * dz1) + 0.001 + 0.2 * (dx2 * dx2 + dz2 * dz2), kRoundOff);
  EXPECT_NEAR(inertia(0, 2), -0.8 * dx1 * dz1 - 0.2 * dx2 * dz2, kRoundOff);

  // The box: 9 mm high, its centre 1 mm below the caster frame, which is 4 mm below base_link.
  ASSERT_EQ(robot.casters.size(), 1u);
  const Caster& caster = robot.casters[0];
  EXPECT_EQ(caster.link, "caster_link");
  EXPECT_FALSE(caster.swivels);
  EXPECT_NEAR(caster.centre_m.x(), -0.081, kRoundOff);
  EXPECT_NEAR(caster.centre_m.z() - caster.radius_m, -0.004 - 0.001 - 0.0045 - 0.023, 0.010 * kRpy157_rad);
}

TEST(PublishedStyles, PioneerLikeSwivels) {
  const RobotModel robot = load_robot(example("pioneer_like.urdf"));
  EXPECT_DOUBLE_EQ(robot.wheels[0].effort_limit_nm, 6);
  EXPECT_TRUE(robot.wheels[0].axis == Eigen::Vector3d::UnitY()) << "the file's left axis is -y";
  // 8 kg hull and 1 kg laser, which a tilt joint holds at zero; not the fork and its wheel.
  EXPECT_NEAR(robot.base.mass_kg, 9, kRoundOff);
  EXPECT_NEAR(robot.base.com_m.x(), (8 * -0.04 + 1 * 0.1) / 9, kRoundOff);
  EXPECT_NEAR(robot.total_mass_kg(), 8 + 1 + 2 * 1.5 + 0.3 + 0.2, kRoundOff);
  ASSERT_EQ(robot.casters.size(), 1u);
  const Caster& caster = robot.casters[0];
  EXPECT_TRUE(caster.swivels);
  EXPECT_EQ(caster.link, "caster_wheel");
  EXPECT_TRUE(caster.swivel_point_m.isApprox(Eigen::Vector3d(-0.2, 0, 0.06 - 0.0975), kRoundOff));
  EXPECT_TRUE(caster.centre_m.isApprox(Eigen::Vector3d(-0.225, 0, 0.0375 - 0.0975), kRoundOff));
  EXPECT_NEAR(caster.fork.mass_kg, 0.3, kRoundOff);
  EXPECT_TRUE(caster.fork.com_m.isApprox(Eigen::Vector3d(-0.21, 0, 0.05 - 0.0975), kRoundOff));
  EXPECT_NEAR(caster.wheel_mass_kg, 0.2, kRoundOff);
  EXPECT_NEAR(caster.wheel_spin_inertia_kgm2, 0.00014, kRoundOff);
  EXPECT_NEAR(caster.wheel_transverse_inertia_kgm2, 0.0001, kRoundOff);
}

TEST(DriveJoints, NamedAndFoundAgree) {
  const RobotModel found = loaded(kRobot);
  const RobotModel named = loaded(kRobot, {"jl", "jr"});
  for (int side = 0; side < 2; ++side) {
    EXPECT_EQ(found.wheels[side].joint, named.wheels[side].joint);
    EXPECT_EQ(found.wheels[side].centre_m, named.wheels[side].centre_m);
  }
  EXPECT_EQ(found.base.inertia_kgm2, named.base.inertia_kgm2);
}

TEST(DriveJoints, NamesDecideWhichWayAnAxleAlongXFaces) {
  // The same robot, drawn facing +y of its root link: (x, y) -> (-y, x).
  std::string turned = with(kRobot, "xyz=\"0 0.2 0\"/><axis xyz=\"0 1 0\"", "xyz=\"-0.2 0 0\"/><axis xyz=\"1 0 0\"");
  turned = with(turned, "xyz=\"0 -0.2 0\"/><axis xyz=\"0 1 0\"", "xyz=\"0.2 0 0\"/><axis xyz=\"1 0 0\"");
  turned = with(turned, "rpy=\"1.5707963 0 0\"", "rpy=\"0 1.5707963 0\"");
  turned = with(turned, "rpy=\"1.5707963 0 0\"", "rpy=\"0 1.5707963 0\"");
  for (int i = 0; i < 2; ++i)
    turned = with(turned, "ixx=\"0.003\" ixy=\"0\" ixz=\"0\" iyy=\"0.005\"",
                  "ixx=\"0.005\" ixy=\"0\" ixz=\"0\" iyy=\"0.003\"");
  turned = with(turned, "xyz=\"0.3 0 -0.07\"", "xyz=\"0 0.3 -0.07\"");
  const RobotModel robot = loaded(turned, {"jl", "jr"});
  EXPECT_TRUE(robot.casters[0].centre_m.isApprox(Eigen::Vector3d(0.3, 0, -0.07), kRoundOff));
  EXPECT_TRUE(robot.base.com_m.isApprox(Eigen::Vector3d(0.01, -0.05, 0.02), kRoundOff));
  EXPECT_NEAR(robot.wheels[0].spin_inertia_kgm2, 0.005, kRoundOff);
  EXPECT_NE(testing::refusal(turned).find("name the left and right drive joints"), std::string::npos);
}

TEST(Mirror, MirroredFileGivesMirroredRobot) {
  std::string mirrored = with(kRobot, "xyz=\"0.05 0.01 0.02\"", "xyz=\"0.05 -0.01 0.02\"");
  mirrored = with(mirrored, "ixy=\"0.01\"", "ixy=\"-0.01\"");
  mirrored = with(mirrored, "xyz=\"0 0.2 0\"", "xyz=\"0 -0.21 0\"");
  mirrored = with(mirrored, "xyz=\"0 -0.2 0\"", "xyz=\"0 0.19 0\"");
  std::string plain = with(kRobot, "xyz=\"0 0.2 0\"", "xyz=\"0 0.21 0\"");
  plain = with(plain, "xyz=\"0 -0.2 0\"", "xyz=\"0 -0.19 0\"");
  const RobotModel a = loaded(plain);
  const RobotModel b = loaded(mirrored);
  EXPECT_EQ(a.wheels[0].joint, b.wheels[1].joint);
  const Eigen::Matrix3d flip = Eigen::Vector3d(1, -1, 1).asDiagonal();
  EXPECT_TRUE(a.base.com_m.isApprox(flip * b.base.com_m, kRoundOff));
  EXPECT_TRUE(a.base.inertia_kgm2.isApprox(flip * b.base.inertia_kgm2 * flip, kRoundOff));
  // The origin is midway between the wheels, 0.01 m to the left of hull's.
  EXPECT_NEAR(a.base.com_m.y(), 0.01 - 0.01, kRoundOff);
  EXPECT_NEAR(a.casters[0].centre_m.y(), -0.01, kRoundOff);
}

TEST(Lumping, MovableSensorsAndUnseenFramesBelongToTheBase) {
  const std::string mast = part("mast", "prismatic", "hull", "0 0 0.5", "0 0 1", "");
  const std::string lidar =
      part("lidar", "continuous", "mast", "0 0 0.1", "0 0 1", "<cylinder radius=\"0.05\" length=\"0.05\"/>");
  const RobotModel robot = loaded(plus(kRobot, mast + lidar +
                                                   "<link name=\"frame\"/><joint name=\"jf\" type=\"fixed\">"
                                                   "<parent link=\"lidar\"/><child link=\"frame\"/></joint>"));
  EXPECT_NEAR(robot.base.mass_kg, 11, kRoundOff);
  EXPECT_NEAR(robot.base.com_m.z(), (10 * 0.02 + 0.5 * 0.5 + 0.5 * 0.6) / 11, kRoundOff);
  EXPECT_EQ(robot.casters.size(), 1u);
}

TEST(Lumping, TyreFixedToTheWheelTurnsWithIt) {
  const RobotModel robot = loaded(plus(kRobot, part("tyre", "fixed", "wheel_l", "0 0 0", "0 1 0", "")));
  EXPECT_NEAR(robot.wheels[0].mass_kg, 1.5, kRoundOff);
  EXPECT_NEAR(robot.wheels[0].spin_inertia_kgm2, 0.005 + 0.001, kRoundOff);
  EXPECT_NEAR(robot.wheels[1].mass_kg, 1.0, kRoundOff);
}

TEST(Lumping, LightSensorMayBeAPoint) {
  std::string imu = part("imu", "fixed", "hull", "0.1 0 0", "1 0 0", "");
  imu = with(imu, "mass value=\"0.5\"", "mass value=\"0.01\"");
  for (const char* moment : {"ixx", "iyy", "izz"})
    imu = with(imu, std::string(moment) + "=\"0.001\"", std::string(moment) + "=\"0\"");
  EXPECT_NEAR(loaded(plus(kRobot, imu)).base.mass_kg, 10.01, kRoundOff);
}

TEST(Casters, ForkWithASphereOfItsOwnSwivels) {
  const std::string fork = part("fork", "continuous", "hull", "-0.2 0 0", "0 0 1", "<sphere radius=\"0.04\"/>");
  const RobotModel robot =
      loaded(plus(kRobot, with(fork, "<collision><origin", "<collision><origin xyz=\"-0.03 0 -0.06\"")));
  ASSERT_EQ(robot.casters.size(), 2u);
  EXPECT_TRUE(robot.casters[1].swivels);
  EXPECT_TRUE(robot.casters[1].centre_m.isApprox(Eigen::Vector3d(-0.23, 0, -0.06), kRoundOff));
  EXPECT_NEAR(robot.casters[1].fork.mass_kg, 0.5, kRoundOff);
  EXPECT_EQ(robot.casters[1].wheel_mass_kg, 0);
}

TEST(Casters, SphereThatTurnsEveryWayIsABall) {
  const std::string chain = part("yaw", "continuous", "hull", "-0.2 0 -0.07", "0 0 1", "") +
                            part("roll", "continuous", "yaw", "0 0 0", "1 0 0", "") +
                            part("pitch", "continuous", "roll", "0 0 0", "0 1 0", "<sphere radius=\"0.03\"/>");
  const RobotModel robot = loaded(plus(kRobot, chain));
  ASSERT_EQ(robot.casters.size(), 2u);
  EXPECT_FALSE(robot.casters[1].swivels);
  EXPECT_NEAR(robot.base.mass_kg, 10 + 3 * 0.5, kRoundOff);
}

TEST(Casters, HullNearTheFloorIsNoSupport) {
  const RobotModel robot = loaded(with(kRobot, "</inertial>\n</link>",
                                       "</inertial><collision><origin xyz=\"0 0 0.005\"/><geometry><box size=\"0.6 0.3 "
                                       "0.2\"/></geometry></collision>\n</link>"));
  EXPECT_EQ(robot.casters.size(), 1u);
}

TEST(Casters, RollerClearOfTheFloorIsNoWheel) {
  const std::string brush = part("brush", "continuous", "hull", "0.2 0 0", "0 1 0",
                                 "<cylinder radius=\"0.03\" length=\"0.3\"/>", "1.5707963 0 0");
  EXPECT_NEAR(loaded(plus(kRobot, brush)).base.mass_kg, 10.5, kRoundOff);
}

}  // namespace
}  // namespace umbsim
