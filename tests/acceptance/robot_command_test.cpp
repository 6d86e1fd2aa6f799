// `umbsim robot`: what is said of public robots, and that each drives as it comes, is completed, or is refused for a
// reason that matters.
#include <map>

#include "tests/acceptance/program.h"

namespace umbsim::acceptance {
namespace {

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

// Its caster points forward at the start and elsewhere at the end, so that it leans otherwise on its springs: an
// encoder counts that. By statics it goes with the springs' travel, and not with the way.
TEST(RobotCommand, OnSpringsACasterThatTurnsIsAnOffsetAndNoDrift) {
  const Desk desk;
  const std::string urdf = std::string(UMBSIM_SOURCE_DIR) + "/tests/sim/urdf/as_they_come/twin_wheel_caster.urdf";
  const auto off_m = [&](const std::string& side_m, const std::string& travel_m) {
    const Outcome run = desk.umbsim(
        {"run", shipped("nominal"), "--force", "--out", "out", "--set", "robot.urdf=" + urdf, "--set",
         "course.side_m=" + side_m, "--set", "runs.per_direction=1", "--set", "calibration.method=none", "--set",
         "robot.suspension={wheel_travel_m: " + travel_m + ", caster_travel_m: " + travel_m + "}"});
    EXPECT_EQ(run.code, 0) << run.err;
    return json_of(desk.home / "out/summary.json").at("umbmark").at("cw").at("centroid_x_m").get<double>();
  };
  const double rigid = off_m("1", "0"), soft = off_m("1", "0.02"), far = off_m("3", "0.02"), half = off_m("1", "0.01");
  EXPECT_LT(std::abs(rigid), 1.2e-5);  // supports sink by 0.1 mm
  EXPECT_GT(std::abs(soft), 4e-5);
  EXPECT_NEAR(far / soft, 1, 0.05);
  EXPECT_NEAR(half / soft, 0.5, 0.05);
}

// Each of this project's own robots with what public ones are like, as it comes.
TEST(RobotCommand, RobotsAsTheyComeDriveASquare) {
  const Desk desk;
  const fs::path folder = fs::path(UMBSIM_SOURCE_DIR) / "tests/sim/urdf/as_they_come";
  const std::set<std::string> refused = {"millimetres", "car", "four_wheels_mimic", "omni", "balancing"};
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".urdf") continue;
    SCOPED_TRACE(entry.path().filename());
    const Outcome run = desk.umbsim({"run", shipped("nominal"), "--force", "--out", "out", "--set",
                                     "robot.urdf=" + entry.path().string(), "--set", "course.side_m=0.3", "--set",
                                     "course.linear_acceleration_mps2=0.1", "--set", "runs.per_direction=1", "--set",
                                     "calibration.method=none"});
    const bool driven = !refused.count(entry.path().stem().string());
    EXPECT_EQ(run.code, driven ? 0 : kBadInput) << run.err;
    if (!driven || run.code != 0) continue;
    const json umbmark = json_of(desk.home / "out/summary.json").at("umbmark");
    EXPECT_LT(umbmark.at("e_max_syst_m").get<double>(), 1e-3) << "a flawless robot comes back";
    // What its recording carries is read again without what lies beside the original.
    EXPECT_EQ(desk.umbsim({"calibrate", "out", "--out", "again", "--method", "heading", "--force"}).code, 0);
  }
}

}  // namespace
}  // namespace umbsim::acceptance
