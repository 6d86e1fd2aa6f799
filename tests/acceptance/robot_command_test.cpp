// `umbsim robot`: what is said of public robots, and that each drives as it comes, is completed, or is refused for a
// reason that matters.
#include <map>

#include "tests/acceptance/program.h"

namespace umbsim::acceptance {
namespace {

constexpr int kBadInput = 2;

const fs::path kPublic = fs::path(UMBSIM_SHARED_DIR) / "robots";

struct Expected {
  int code;
  std::vector<std::string> words;
};

// Dimensions as in the files' own comments and properties.
const std::map<std::string, Expected> kRobots = {
    {"create3", {0, {"on 3 supports", "by joint wheel_drop_left_joint", "track 233.00 mm"}}},
    {"husky_clearpath", {kBadInput, {"four driven wheels", "skid steering"}}},
    {"jackal", {kBadInput, {"four driven wheels"}}},
    {"kobuki", {0, {"on 4 supports", "radius 35.00 mm", "the default for more than three supports"}}},
    {"linorobot2_2wd", {0, {"on 4 supports"}}},
    {"mir100", {0, {"on 6 supports", "a swivelling wheel"}}},
    {"ros2_control_diffbot", {0, {"is the right wheel by its place", "its name says left"}}},
    {"stretch_re1_no_tool", {kBadInput, {"link_left_wheel_collision.STL' is not found", "--wheel-radius"}}},
    {"turtlebot3_burger", {0, {"on 3 supports", "track 160.00 mm", "radius 33.00 mm"}}},
    {"turtlebot3_waffle", {0, {"on 4 supports", "track 288.00 mm"}}},
    {"turtlebot3_waffle_pi", {0, {"track 288.00 mm"}}},
    {"turtlebot4", {0, {"Wrong", "it tips over above 0.16", "lower course.linear_acceleration_mps2"}}},
};

void expect_words(const std::string& text, const std::vector<std::string>& words) {
  std::string flat;  // lines are wrapped
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool space = text[i] == ' ' || text[i] == '\n';
    if (!space)
      flat += text[i];
    else if (!flat.empty() && flat.back() != ' ')
      flat += ' ';
  }
  for (const std::string& word : words)
    EXPECT_NE(flat.find(word), std::string::npos) << "no '" << word << "' in: " << flat;
}

TEST(RobotCommand, PublicRobots) {
  if (!fs::exists(kPublic)) GTEST_SKIP() << kPublic << " is not there";
  const Desk desk;
  for (const auto& [name, expected] : kRobots) {
    SCOPED_TRACE(name);
    const Outcome outcome = desk.umbsim({"robot", (kPublic / (name + ".urdf")).string()});
    EXPECT_EQ(outcome.code, expected.code) << outcome.err;
    expect_words(expected.code == 0 ? outcome.out : outcome.err, expected.words);
  }
}

TEST(RobotCommand, MeshWheelsWithAGivenSizeAreDrivenAndCarried) {
  if (!fs::exists(kPublic)) GTEST_SKIP() << kPublic << " is not there";
  const Desk desk;
  const std::string urdf = (kPublic / "stretch_re1_no_tool.urdf").string();
  const Outcome said = desk.umbsim({"robot", urdf, "--wheel-radius", "0.0508", "--wheel-width", "0.03"});
  EXPECT_EQ(said.code, 0) << said.err;
  expect_words(said.out, {"Assumed", "wheel radius 0.0508 m, width 0.03 m from the given size", "track 340.70 mm"});
  const Outcome run =
      desk.umbsim({"run", shipped("nominal"), "--out", "out", "--set", "robot.urdf=" + urdf, "--set",
                   "robot.wheel_radius_m=0.0508", "--set", "course.side_m=1", "--set",
                   "course.linear_acceleration_mps2=0.1", "--set", "course.angular_acceleration_radps2=0.5"});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.err.find("the given radius"), std::string::npos) << run.err;
  // Its copy holds the wheels: it is read without the mesh and without the size.
  const Outcome again = desk.umbsim({"robot", "out/stretch_re1_no_tool.urdf"});
  EXPECT_EQ(again.code, 0) << again.err;
  expect_words(again.out, {"radius 50.80 mm", "track 340.70 mm"});
}

TEST(RobotCommand, Picture) {
  const Desk desk;
  const Outcome outcome = desk.umbsim({"robot", "labmate.urdf", "--picture", "robot.svg"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const std::string svg = text_of(desk.home / "robot.svg");
  EXPECT_EQ(svg.rfind("<svg", 0), 0u);
  for (const char* word : {"labmate.urdf", "centre of mass", "from above", "from its right", "</svg>"}) {
    EXPECT_NE(svg.find(word), std::string::npos) << word;
  }
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

TEST(RobotCommand, RefusedWithFileAndBound) {
  const Desk desk;
  EXPECT_EQ(desk.umbsim({"robot", "nowhere.urdf"}).code, kBadInput);
  EXPECT_EQ(desk.umbsim({"robot", "labmate.urdf", "--wheel-radius", "-1"}).code, kBadInput);
  EXPECT_EQ(desk.umbsim({"robot"}).code, kBadInput);
  const Outcome set = desk.umbsim({"run", shipped("nominal"), "--set", "robot.suspension={wheel_travel_m: -1}"});
  EXPECT_EQ(set.code, kBadInput);
  EXPECT_NE(set.err.find("wheel_travel_m"), std::string::npos) << set.err;
  EXPECT_FALSE(fs::exists(desk.home / "results"));
}

// The labmate's weight in the middle of four balls of a table whose floor is uneven.
TEST(RobotCommand, AWheelWithoutLoadIsSaidEverywhere) {
  if (!fs::exists(kPublic)) GTEST_SKIP() << kPublic << " is not there";
  const Desk desk;
  const Outcome run = desk.umbsim({"run", shipped("nominal"), "--out", "out", "--set",
                                   "robot.urdf=" + (kPublic / "kobuki.urdf").string(), "--set", "course.side_m=1",
                                   "--set", "noise.floor_rms_m=0.002", "--set",
                                   "robot.suspension={wheel_travel_m: 0.001, caster_travel_m: 0.001}"});
  ASSERT_EQ(run.code, 0) << run.err;
  expect_words(run.out, {"Wheel loads: left", "Warning: the left wheel carried no load"});
  const json summary = json_of(desk.home / "out/summary.json");
  EXPECT_EQ(summary.at("loads").at("left").at("least_n"), 0);
  EXPECT_GT(summary.at("loads").at("left").at("mean_n"), 1);
  EXPECT_NE(summary.at("warnings").dump().find("carried no load"), std::string::npos);
  EXPECT_NE(text_of(desk.home / "out/report.html").find("carried no load"), std::string::npos);
}

}  // namespace
}  // namespace umbsim::acceptance
