// Flaws of URDFs that do not matter to a drive on the floor: they are completed, and said.
#include <gtest/gtest.h>

#include <algorithm>

#include "sim/urdf/completed.h"
#include "tests/sim/urdf_text.h"

namespace umbsim {
namespace {

using testing::kRobot;
using testing::part;
using testing::plus;
using testing::with;
using testing::written;
using Kind = Remark::Kind;

struct Read {
  RobotModel robot;
  std::vector<Remark> remarks;

  bool says(Kind kind, const std::string& a, const std::string& b) const {
    return std::any_of(remarks.begin(), remarks.end(), [&](const Remark& r) {
      return r.kind == kind && r.text.find(a) != r.text.npos && r.text.find(b) != r.text.npos;
    });
  }
};

Read read(const std::string& text, const WheelSize& size = {}) {
  Read result;
  result.robot = load_robot(written(text), {}, size, &result.remarks);
  return result;
}

std::string finger(const std::string& inertia, const std::string& mass = "0.1") {
  return "<link name=\"finger\"><inertial><mass value=\"" + mass + "\"/>" + inertia +
         "</inertial><collision><geometry><box size=\"0.06 0.02 0.04\"/></geometry></collision></link>"
         "<joint name=\"grip\" type=\"prismatic\"><parent link=\"hull\"/><child link=\"finger\"/>"
         "<origin xyz=\"0 0 0.5\"/><axis xyz=\"1 0 0\"/></joint>";
}

TEST(CompletedLinks, PlainRobotNeedsNoWords) { EXPECT_TRUE(read(kRobot).remarks.empty()); }

TEST(CompletedLinks, LightLinkWithAnImpossibleInertia) {
  const char* bad = "<inertia ixx=\"1e-6\" ixy=\"1e-3\" ixz=\"0\" iyy=\"1e-6\" iyz=\"0\" izz=\"1e-6\"/>";
  const Read got = read(plus(kRobot, finger(bad)));
  EXPECT_TRUE(got.says(Kind::assumed, "finger", "not positive definite"));
  EXPECT_TRUE(got.says(Kind::assumed, "grip", "<limit>"));  // a missing limit stops nobody, too
  EXPECT_TRUE(got.says(Kind::ignored, "position zero", "grip"));
  EXPECT_NEAR(got.robot.base.mass_kg, 10.1, 1e-12);
  // By hand: a box of 0.06 x 0.02 x 0.04 m, 0.1 kg, at (0, 0, 0.5), beside 10 kg at (0.05, 0.01, 0.02).
  const double reduced = 10 * 0.1 / 10.1;
  const double yaw = 0.4 + 0.1 / 12 * (0.06 * 0.06 + 0.02 * 0.02) + reduced * (0.05 * 0.05 + 0.01 * 0.01);
  EXPECT_NEAR(got.robot.base.inertia_kgm2(2, 2), yaw, 1e-12);
  // Half a kilogram is 4 % of the robot, a kilogram 7 %: that is no detail.
  EXPECT_NO_THROW(read(plus(kRobot, finger(bad, "0.5"))));
  EXPECT_THROW(read(plus(kRobot, finger(bad, "1"))), InputError);
}

TEST(CompletedLinks, DriveWheelsAreDiscs) {
  const char* inertial =
      "  <inertial><mass value=\"1\"/><inertia ixx=\"0.003\" ixy=\"0\" ixz=\"0\" iyy=\"0.005\" iyz=\"0\" "
      "izz=\"0.003\"/></inertial>\n";
  const Read none = read(with(kRobot, inertial, ""));
  EXPECT_TRUE(none.says(Kind::assumed, "link 'wheel_l'", "without mass; taken as a uniform disc of 0.275 kg"));
  EXPECT_NEAR(none.robot.wheels[0].mass_kg, 0.025 * 11, 1e-12);  // of the hull and the other wheel
  EXPECT_NEAR(none.robot.wheels[0].spin_inertia_kgm2, 0.275 * 0.1 * 0.1 / 2, 1e-12);
  const Read impossible = read(with(kRobot, "iyy=\"0.005\"", "iyy=\"0.007\""));
  EXPECT_TRUE(impossible.says(Kind::assumed, "link 'wheel_l'", "triangle inequality"));
  EXPECT_NEAR(impossible.robot.wheels[0].spin_inertia_kgm2, 0.005, 1e-12);
  const Read copied = read(with(kRobot, "ixx=\"0.003\" ixy=\"0\" ixz=\"0\" iyy=\"0.005\" iyz=\"0\" izz=\"0.003\"",
                                "ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" iyz=\"0\" izz=\"1\""));
  EXPECT_TRUE(copied.says(Kind::assumed, "link 'wheel_l'", "more than the whole robot's mass at its rim"));
}

TEST(CompletedLinks, WheelsAreBalanced) {
  const Read got =
      read(with(kRobot, "<inertial><mass value=\"1\"", "<inertial><origin xyz=\"0.02 0 0\"/><mass value=\"1\""));
  EXPECT_TRUE(got.says(Kind::assumed, "link 'wheel_l'", "0.02 m off the joint axis; taken as on it"));
  EXPECT_NEAR(got.robot.wheels[0].spin_inertia_kgm2, 0.005, 1e-12);
}

TEST(CompletedLinks, ShapeOfNoSize) {
  const std::string sonar =
      "<link name=\"sonar\"><collision><geometry><box size=\"0 0.1 0.1\"/></geometry></collision></link>"
      "<joint name=\"js\" type=\"fixed\"><parent link=\"hull\"/><child link=\"sonar\"/></joint>";
  EXPECT_TRUE(read(plus(kRobot, sonar)).says(Kind::ignored, "sonar", "size of 0 m"));
}

TEST(CompletedLinks, MasslessBehindAJoint) {
  const std::string nod =
      "<link name=\"head\"/><joint name=\"nod\" type=\"revolute\"><parent link=\"hull\"/>"
      "<child link=\"head\"/><axis xyz=\"0 1 0\"/><limit effort=\"1\" velocity=\"1\"/></joint>";
  EXPECT_DOUBLE_EQ(read(plus(kRobot, nod)).robot.total_mass_kg(), 12);
}

TEST(CompletedLinks, ColoursThatNobodyDefined) {
  const std::string visual =
      "</inertial><visual><geometry><sphere radius=\"0.1\"/></geometry><material name=\"mauve\"/></visual>\n";
  EXPECT_EQ(read(with(kRobot, "</inertial>\n", visual)).robot.casters.size(), 1u);
}

// A swivel and its wheel without any <inertial>, in the place of the ball.
std::string with_bare_caster() {
  std::string text = kRobot.substr(0, kRobot.find("<link name=\"ball\">"));
  return text +
         "<link name=\"fork\"/><joint name=\"swivel\" type=\"continuous\"><parent link=\"hull\"/><child link=\"fork\"/>"
         "<origin xyz=\"0.3 0 0\"/><axis xyz=\"0 0 1\"/></joint>\n"
         "<link name=\"roll\"><collision><origin rpy=\"1.5707963 0 0\"/><geometry><cylinder radius=\"0.04\" "
         "length=\"0.02\"/></geometry></collision></link>"
         "<joint name=\"caster_wheel\" type=\"continuous\"><parent link=\"fork\"/><child link=\"roll\"/>"
         "<origin xyz=\"-0.03 0 -0.06\"/><axis xyz=\"0 1 0\"/></joint>\n</robot>\n";
}

TEST(CompletedLinks, CasterWithoutMass) {
  const Read got = read(with_bare_caster());
  ASSERT_EQ(got.robot.casters.size(), 1u);
  const Caster& c = got.robot.casters[0];
  EXPECT_TRUE(c.swivels);
  EXPECT_TRUE(got.says(Kind::assumed, "fork", "without mass"));
  EXPECT_TRUE(got.says(Kind::assumed, "roll", "without mass"));
  EXPECT_NEAR(c.fork.mass_kg, 0.12, 1e-12);   // 1 % of 12 kg
  EXPECT_NEAR(c.wheel_mass_kg, 0.06, 1e-12);  // 0.5 %
  EXPECT_NEAR(c.wheel_spin_inertia_kgm2, 0.06 * 0.04 * 0.04 / 2, 1e-12);
}

TEST(UnderstoodRobots, NamesOfTheWrongSide) {
  std::string text = with(kRobot, "joint name=\"jl\"", "joint name=\"right_joint\"");
  text = with(text, "joint name=\"jr\"", "joint name=\"left_joint\"");
  const Read got = read(text);
  EXPECT_EQ(got.robot.wheels[0].joint, "right_joint");
  EXPECT_TRUE(got.says(Kind::understood, "right_joint", "left wheel by its place"));
}

TEST(UnderstoodRobots, RadiiThatDiffer) {
  const Read got = read(with(kRobot, "radius=\"0.1\"", "radius=\"0.0995\""));
  EXPECT_TRUE(got.says(Kind::understood, "left 0.0995 m", "right 0.1 m"));
}

TEST(UnderstoodRobots, BallOnAJointIsACaster) {
  std::string text = with(kRobot, "name=\"jb\" type=\"fixed\"", "name=\"jb\" type=\"continuous\"");
  text = with(text, "xyz=\"0.3 0 -0.07\"/>", "xyz=\"0.3 0 -0.07\"/><axis xyz=\"0 1 0\"/>");
  const Read got = read(text);
  ASSERT_EQ(got.robot.casters.size(), 1u);
  EXPECT_TRUE(got.says(Kind::understood, "jb", "caster"));
}

TEST(UnderstoodRobots, RevoluteWithoutEndIsAWheel) {
  std::string text = with(kRobot, "name=\"jl\" type=\"continuous\"", "name=\"jl\" type=\"revolute\"");
  text = with(text, "<axis xyz=\"0 1 0\"/>",
              "<axis xyz=\"0 1 0\"/><limit lower=\"-1e16\" upper=\"1e16\" effort=\"2\" velocity=\"9\"/>");
  EXPECT_EQ(read(text).robot.wheels[0].joint, "jl");
}

TEST(UnderstoodRobots, BallThatIsALittleHighIsLeanedOn) {
  const Read got = read(with(kRobot, "xyz=\"0.3 0 -0.07\"", "xyz=\"0.3 0 -0.056\""));  // 14 mm: 2.7 degrees
  EXPECT_TRUE(got.says(Kind::assumed, "ball", "14.0 mm above the floor"));
}

TEST(UnderstoodRobots, PrismaticJointIsASuspension) {
  std::string text = with(kRobot, "<parent link=\"hull\"/><child link=\"wheel_l\"/>",
                          "<parent link=\"drop\"/><child link=\"wheel_l\"/>");
  text = plus(text,
              "<link name=\"drop\"/><joint name=\"jd\" type=\"prismatic\"><parent link=\"hull\"/><child link=\"drop\"/>"
              "<axis xyz=\"0 0 -1\"/><limit lower=\"-0.01\" upper=\"0.02\" effort=\"1\" velocity=\"1\"/></joint>"
              "<gazebo reference=\"jd\"><springStiffness>400</springStiffness>"
              "<springReference>0.03</springReference></gazebo>");
  const Slide slide = read(text).robot.wheels[0].slide;
  EXPECT_EQ(slide.joint, "jd");
  EXPECT_DOUBLE_EQ(slide.up_m, 0.01);
  EXPECT_DOUBLE_EQ(slide.down_m, 0.02);
  EXPECT_DOUBLE_EQ(slide.stiffness_npm, 400);
  EXPECT_DOUBLE_EQ(slide.preload_n, 12);  // pushes down: 400 N/m over 0.03 m
}

}  // namespace
}  // namespace umbsim
