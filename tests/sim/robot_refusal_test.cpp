// Every file that load_robot refuses, and that its message names file, line, link and joint and says what to do.
#include <gtest/gtest.h>

#include <initializer_list>
#include <string>

#include "tests/sim/urdf_text.h"

namespace umbsim {
namespace {

using testing::kRobot;
using testing::part;
using testing::plus;
using testing::refusal;
using testing::refusal_of_file;
using testing::with;
using testing::written;

void expect_says(const std::string& message, std::initializer_list<const char*> parts) {
  for (const char* text : parts) {
    EXPECT_NE(message.find(text), std::string::npos) << "no '" << text << "' in: " << message;
  }
}

const char* const kCylinder = "<cylinder radius=\"0.1\" length=\"0.04\"/>";
std::string wheel(const std::string& name, const std::string& xyz) {
  return part(name, "continuous", "hull", xyz, "0 1 0", kCylinder, "1.5707963 0 0");
}

TEST(RefusedFiles, NotAUrdf) {
  expect_says(refusal_of_file("no_such_file.urdf"), {"no_such_file.urdf", "cannot be read"});
  expect_says(refusal_of_file(::testing::TempDir()), {"is a folder"});
  expect_says(refusal(" \n"), {"mini.urdf: is empty"});
  expect_says(refusal("wheels: 2\n"), {"mini.urdf", "not well-formed XML"});
  expect_says(refusal("<robot name=\"a\">\n<link name=\"b\">\n</robot>\n"), {"mini.urdf:2:", "mismatched element"});
  expect_says(refusal(kRobot.substr(0, kRobot.size() / 2)), {"mini.urdf:", "not well-formed XML"});
  expect_says(refusal("<sdf version=\"1.7\"/>"), {"mini.urdf:1:", "an SDF file"});
  expect_says(refusal("<mujoco/>"), {"<mujoco>", "not <robot>"});
}

TEST(RefusedFiles, Xacro) {
  expect_says(refusal(plus(kRobot, "<xacro:include filename=\"a\"/>")),
              {"mini.urdf:20:", "xacro:include", "run `xacro"});
  expect_says(refusal(with(kRobot, "mass value=\"10\"", "mass value=\"${m}\"")),
              {"mini.urdf:3:", "${m}", "run `xacro"});
}

TEST(RefusedFiles, WhatUrdfdomComplainsOf) {
  expect_says(refusal("<robot name=\"a\"/>"), {"mini.urdf", "No link"});
  expect_says(refusal(plus(kRobot, "<link name=\"hull\"/>")), {"mini.urdf", "hull", "not unique"});
  expect_says(refusal(with(kRobot, "<child link=\"ball\"/>", "<child link=\"bell\"/>")), {"mini.urdf", "bell", "jb"});
  expect_says(refusal(with(kRobot, "mass value=\"10\"", "mass value=\"ten\"")), {"mini.urdf", "hull"});
  expect_says(refusal(with(kRobot, "xyz=\"0.3 0 -0.07\"", "xyz=\"0.3 0\"")), {"mini.urdf:19:", "jb"});
}

TEST(RefusedFiles, NumbersThatUrdfdomWouldDrop) {
  expect_says(refusal(with(kRobot, "mass value=\"10\"", "mass value=\"nan\"")), {"mini.urdf:2:", "nan", "link 'hull'"});
  expect_says(refusal(with(kRobot, "ixy=\"0.01\"", "")), {"mini.urdf:2:", "ixy", "hull"});
  expect_says(refusal(with(kRobot, "radius=\"0.03\"", "radius=\"inf\"")),
              {"mini.urdf:18:", "inf", "link 'ball' (joint 'jb')"});
  expect_says(refusal(with(kRobot, "<sphere radius=\"0.03\"/>", "<capsule/>")),
              {"falls over", "link 'ball'", "<capsule>", "no shape of URDF"});
  expect_says(
      refusal(with(kRobot, "<axis xyz=\"0 1 0\"/>", "<axis xyz=\"0 1 0\"/><limit effort=\"-1\" velocity=\"1\"/>")),
      {"mini.urdf:10:", "joint 'jl' (link 'wheel_l')", "effort is -1"});
}

TEST(AcceptedFiles, VisualsAreNoMatter) {
  const std::string visual = "</inertial><visual><geometry><capsule/></geometry></visual>\n";
  EXPECT_EQ(testing::loaded(with(kRobot, "</inertial>\n", visual)).casters.size(), 1u);
}

TEST(RefusedFiles, BrokenTree) {
  expect_says(refusal(plus(kRobot, "<link name=\"lost\"/>")), {"mini.urdf", "lost", "root"});
  const std::string again =
      "<joint name=\"jb2\" type=\"fixed\"><parent link=\"wheel_l\"/><child link=\"ball\"/></joint>";
  expect_says(refusal(plus(kRobot, again)), {"mini.urdf:18:", "link 'ball'", "more than one joint"});
}

TEST(RefusedMasses, MasslessLinks) {
  // Without its hull nothing is left that weighs.
  std::string bare = kRobot;
  for (std::size_t at; (at = bare.find("<inertial>")) != std::string::npos;)
    bare.erase(at, bare.find("</inertial>") + 11 - at);
  expect_says(refusal(bare), {"mini.urdf:2:", "link 'hull'", "massless"});
}

TEST(RefusedMasses, HullWithoutInertial) {
  std::string bare = kRobot;
  const auto from = bare.find("  <inertial>"), to = bare.find("</inertial>") + 11;
  bare.erase(from, to - from);
  expect_says(refusal(bare), {"mini.urdf:2:", "link 'hull'", "massless"});
  const std::string shaped =
      with(bare, "<link name=\"hull\">",
           "<link name=\"hull\"><collision><geometry><box size=\"0.3 0.2 0.1\"/></geometry></collision>");
  const std::string sensor = part("sensor", "fixed", "hull", "0 0 0.1", "1 0 0", "<sphere radius=\"0.01\"/>");
  expect_says(refusal(plus(shaped, sensor)), {"link 'hull'", "massless", "drive joint 'jl'"});
}

TEST(RefusedMasses, ImpossibleInertia) {
  expect_says(refusal(with(kRobot, "mass value=\"10\"", "mass value=\"-10\"")),
              {"mini.urdf:2:", "link 'hull'", "mass is -10 kg"});
  expect_says(refusal(with(kRobot, "izz=\"0.4\"", "izz=\"-0.4\"")), {"link 'hull'", "not positive definite", "-0.4"});
  expect_says(refusal(with(kRobot, "izz=\"0.4\"", "izz=\"0.6\"")), {"link 'hull'", "triangle inequality", "0.6"});
  // A wheel of a quarter of the robot is no detail.
  const std::string heavy = with(kRobot, "mass value=\"1\"", "mass value=\"4\"");
  expect_says(refusal(with(heavy, "iyy=\"0.005\"", "iyy=\"0.007\"")), {"link 'wheel_l' (joint 'jl')", "triangle"});
}

TEST(RefusedWheels, ShapesThatCannotRoll) {
  const std::string mesh = "<mesh filename=\"package://a/wheel.stl\"/>";
  expect_says(refusal(with(kRobot, kCylinder, mesh)),
              {"mini.urdf:10:", "joint 'jl' (link 'wheel_l')", "mesh", "<cylinder> or <sphere>"});
  std::string bare = kRobot;
  const auto from = bare.find("  <collision>"), to = bare.find("</collision>") + 12;
  bare.erase(from, to - from);
  expect_says(refusal(bare), {"joint 'jl'", "no collision", "--wheel-radius", "robot.wheel_radius_m"});
  expect_says(refusal(with(kRobot, "<origin rpy=\"1.5707963 0 0\"/>", "")),
              {"joint 'jl'", "across the joint axis", "rpy"});
  expect_says(
      refusal(with(kRobot, "<origin rpy=\"1.5707963 0 0\"/>", "<origin rpy=\"1.5707963 0 0\" xyz=\"0.01 0 0\"/>")),
      {"joint 'jl'", "0.01 m off the joint axis"});
  expect_says(refusal(with(kRobot, "radius=\"0.1\"", "radius=\"0\"")), {"wheel_l", "must be positive"});
  expect_says(refusal(with(kRobot, "radius=\"0.1\"", "radius=\"0.092\"")), {"joint 'jr'", "0.092 m", "differ"});
}

TEST(RefusedWheels, NotTwoOnOneAxle) {
  std::string none = with(kRobot, "continuous", "fixed");
  expect_says(refusal(with(none, "continuous", "fixed")), {"mini.urdf", "no drive wheels", "continuous"});
  expect_says(refusal(none), {"joint 'jr' (link 'wheel_r')", "only continuous joint"});
  expect_says(refusal(with(kRobot, "xyz=\"0 -0.2 0\"", "xyz=\"0.02 -0.2 0\"")),
              {"joint 'jr' (link 'wheel_r')", "not collinear with joint 'jl' (link 'wheel_l')", "0.05 rad"});
  expect_says(refusal(with(kRobot, "<axis xyz=\"0 1 0\"/>", "<axis xyz=\"0 0 0\"/>")), {"joint 'jl'", "0 0 0"});
}

TEST(RefusedWheels, MoreThanTwo) {
  expect_says(refusal_of_file(std::string(UMBSIM_SOURCE_DIR) + "/tests/sim/urdf/husky_like.urdf"),
              {"husky_like.urdf", "four driven wheels", "'front_left_wheel'", "'rear_right_wheel'",
               "skid steering is not supported"});
  const std::string four = plus(kRobot, wheel("fl", "0.5 0.2 0") + wheel("fr", "0.5 -0.2 0"));
  expect_says(refusal(four, {"jl", "jr"}), {"four driven wheels", "'fl_joint'", "skid steering"});
  expect_says(refusal(plus(kRobot, wheel("rear", "-0.4 0 0"))),
              {"joint 'rear_joint' (link 'rear')", "third wheel", "'jl', 'jr'", "ball caster"});
  expect_says(refusal(plus(kRobot, wheel("twin", "0 0.3 0"))),
              {"joint", "twin", "two candidates for a wheel", "collinear"});
}

TEST(RefusedNames, DriveJointsThatDoNotFit) {
  expect_says(refusal(kRobot, {"left", "jr"}), {"mini.urdf", "drive joint 'left' does not exist", "'jl', 'jr'"});
  expect_says(refusal(kRobot, {"jl", "jb"}), {"mini.urdf:19:", "joint 'jb' (link 'ball')", "must be continuous"});
  expect_says(refusal(kRobot, {"jl", ""}), {"name both drive joints or none"});
  expect_says(refusal(kRobot, {"jl", "jl"}), {"name both drive joints or none", "'jl'"});
  expect_says(refusal(kRobot, {"jr", "jl"}),
              {"joint 'jr' (link 'wheel_r')", "named left", "on the right of joint 'jl'"});
}

TEST(RefusedSupports, FallsOver) {
  expect_says(refusal(with(kRobot, "xyz=\"0.3 0 -0.07\"", "xyz=\"0.3 0 -0.04\"")),
              {"mini.urdf:2:", "link 'hull'", "falls over", "link 'ball' (joint 'jb')", "30.0 mm above the floor"});
  expect_says(refusal(with(kRobot, "xyz=\"0.3 0 -0.07\"", "xyz=\"0.3 0 -0.09\"")), {"falls over", "20.0 mm below"});
  expect_says(refusal(with(kRobot, "xyz=\"0.3 0 -0.07\"", "xyz=\"0 0 -0.07\"")), {"falls over", "off the axle"});
  expect_says(refusal(with(kRobot, "<sphere radius=\"0.03\"/>", "<mesh filename=\"package://a/ball.stl\"/>")),
              {"falls over", "<sphere>", "swivelling caster"});
}

TEST(RefusedSupports, SwivelsThatCannotSupport) {
  const std::string fork = part("fork", "continuous", "hull", "-0.2 0 0", "0 0 1", "");
  const auto small = [](const char* name, const char* xyz, const char* axis) {
    return part(name, "continuous", "fork", xyz, axis, "<cylinder radius=\"0.03\" length=\"0.01\"/>", "1.5707963 0 0");
  };
  expect_says(refusal(plus(
                  kRobot, fork + small("w1", "-0.03 0.02 -0.07", "0 1 0") + small("w2", "-0.05 -0.02 -0.07", "0 1 0"))),
              {"link 'w2' (joint 'w2_joint')", "a second wheel", "joint 'fork_joint'"});
  expect_says(refusal(plus(kRobot, fork + small("w1", "-0.03 0 -0.07", "0 0.7 0.7"))),
              {"link 'w1' (joint 'w1_joint')", "behind a swivel", "horizontal"});
}

}  // namespace
}  // namespace umbsim
