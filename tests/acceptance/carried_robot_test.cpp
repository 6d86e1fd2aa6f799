// A result carries its robot: moved to another place, without the URDF that it was driven with and without robots/, it
// can be driven again, predicted and diagnosed.
#include "tests/acceptance/program.h"

namespace umbsim::acceptance {
namespace {

/// A LabMate with a wheelbase of its own, under a name that needs care, beside nothing else of ours.
class CarriedRobot : public testing::Test {
 protected:
  CarriedRobot() {
    std::string urdf = text_of(fs::path(UMBSIM_SOURCE_DIR) / "robots/labmate.urdf");
    for (const std::string side : {"0.17", "-0.17"}) {
      const std::string old = "<origin xyz=\"0 " + side + " 0\"/>";
      const std::size_t at = urdf.find(old);
      EXPECT_NE(at, std::string::npos) << old;
      urdf.replace(at + old.find("0.17"), 4, "0.155");
    }
    urdf_ = urdf;
    desk_.put("elsewhere/my robot.urdf", urdf);
    desk_.put("short.yaml", kShortScenario);
  }

  /// The program where there is no folder robots/.
  Outcome umbsim(const std::vector<std::string>& words) const {
    std::string line = "UMBSIM_ROBOTS=/nowhere " + shell_quoted(UMBSIM_PROGRAM);
    for (const std::string& word : words) line += " " + shell_quoted(word);
    return desk_.shell(line);
  }

  void expect_done(const std::vector<std::string>& words) const {
    const Outcome o = umbsim(words);
    EXPECT_EQ(o.code, 0) << words[0] << ": " << o.err;
  }

  /// Somewhere else, with the URDF that was given gone.
  void take_away(const std::string& from, const std::string& to) const {
    fs::create_directories((desk_.home / to).parent_path());
    fs::rename(desk_.home / from, desk_.home / to);
    fs::remove_all(desk_.home / "elsewhere");
  }

  Desk desk_;
  std::string urdf_;
};

const std::vector<std::string> kElsewhere = {"--set", "robot.urdf=elsewhere/my robot.urdf"};

std::vector<std::string> with(std::vector<std::string> words, const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST_F(CarriedRobot, ByEveryRecordingOfARun) {
  expect_done(with({"run", "short.yaml", "--out", "a"}, kElsewhere));
  for (const std::string recording : {"a/", "a/calibrated/"}) {
    EXPECT_EQ(text_of(desk_.home / (recording + "my_robot.urdf")), urdf_) << recording;
    expect_says(text_of(desk_.home / (recording + "recording.yaml")), {"urdf: my_robot.urdf", "wheelbase_m: 0.31"});
  }
  expect_says(text_of(desk_.home / "a/scenario.resolved.yaml"), {"urdf: my_robot.urdf"});
}

TEST_F(CarriedRobot, TheResolvedScenarioDrivesTheSameAgain) {
  expect_done(with({"run", "short.yaml", "--out", "a"}, kElsewhere));
  take_away("a", "moved/b");
  expect_done({"run", "moved/b/scenario.resolved.yaml", "--out", "c"});
  auto before = files_of(desk_.home / "moved/b"), after = files_of(desk_.home / "c");
  EXPECT_EQ(names_of(before), names_of(after));
  for (const auto& [name, text] : before) {
    if (name == "summary.json" || name == "provenance.json") continue;  // hold the time it took, the input's name
    EXPECT_TRUE(text == after[name]) << name << " differs";
  }
  expect_done({"explain", "moved/b/scenario.resolved.yaml", "--out", "e"});
  take_away("e", "moved/e");
  expect_done({"run", "moved/e/scenario.resolved.yaml", "--out", "f"});
}

TEST_F(CarriedRobot, ARunIsDiagnosedAndItsTwinDrives) {
  expect_done(with({"run", "short.yaml", "--out", "a"}, kElsewhere));
  take_away("a", "moved/b");
  expect_done({"gap", "diagnose", "moved/b", "--out", "d"});
  EXPECT_EQ(text_of(desk_.home / "d/my_robot.urdf"), urdf_);
  take_away("d", "moved/d");
  expect_done({"gap", "predict", "moved/b", "--scenario", "moved/d/twin.yaml", "--out", "p"});
  expect_done({"run", "moved/d/twin.yaml", "--set", "runs.per_direction=1", "--out", "t"});
  expect_says(text_of(desk_.home / "t/recording.yaml"), {"wheelbase_m: 0.31"});
}

// A shipped robot goes along, too: another version of the program may have another one of that name.
TEST_F(CarriedRobot, AShippedOneToo) {
  ASSERT_EQ(desk_.umbsim({"run", "short.yaml", "--out", "a"}).code, 0);
  EXPECT_EQ(text_of(desk_.home / "a/labmate.urdf"), text_of(fs::path(UMBSIM_SOURCE_DIR) / "robots/labmate.urdf"));
  expect_done({"run", "a/scenario.resolved.yaml", "--out", "b"});
}

// Older recordings have no copy: their robot is found in robots/.
TEST_F(CarriedRobot, AnOlderRecordingFindsItsRobotInRobots) {
  ASSERT_EQ(desk_.umbsim({"run", "short.yaml", "--out", "a"}).code, 0);
  fs::remove(desk_.home / "a/labmate.urdf");
  EXPECT_EQ(desk_.umbsim({"gap", "plan", "a", "--effects", "wheelbase,backlash", "--out", "p"}).code, 0);
  EXPECT_EQ(umbsim({"gap", "plan", "a", "--effects", "wheelbase,backlash", "--out", "q"}).code, 2);
}

// Where the URDF does not tell which wheel is the left one (here its x points along the axle, and no name tells), the
// recording does.
TEST_F(CarriedRobot, WithTheJointsThatDriveIt) {
  for (const auto& [upright, turned] :
       std::map<std::string, std::string>{{"\"0 0.155 0\"", "\"-0.155 0 0\""},
                                          {"\"0 -0.155 0\"", "\"0.155 0 0\""},
                                          {"<axis xyz=\"0 1 0\"", "<axis xyz=\"-1 0 0\""},
                                          {"\"0.06 0 0.05\"", "\"0 0.06 0.05\""},
                                          {"\"1.5707963267948966 0 0\"", "\"0 1.5707963267948966 0\""},
                                          {"\"0.25 0 -0.045\"", "\"0 0.25 -0.045\""},
                                          {"ixx=\"0.00148125\"", "ixx=\"0.0028125\""},
                                          {"iyy=\"0.0028125\"", "iyy=\"0.00148125\""},
                                          {"left_wheel", "wheel_a"},
                                          {"right_wheel", "wheel_b"}}) {
    EXPECT_NE(urdf_.find(upright), std::string::npos) << upright;
    for (std::size_t at = urdf_.find(upright); at != std::string::npos; at = urdf_.find(upright)) {
      urdf_.replace(at, upright.size(), turned);
    }
  }
  desk_.put("elsewhere/my robot.urdf", urdf_);
  const std::vector<std::string> drive = with({"run", "short.yaml", "--out", "a"}, kElsewhere);
  EXPECT_EQ(umbsim(drive).code, 2);
  expect_done(
      with(drive, {"--set", "robot.left_joint=wheel_a_joint", "--set", "robot.right_joint=wheel_b_joint"}));
  expect_done({"gap", "plan", "a", "--effects", "wheelbase,backlash", "--out", "p"});
}

}  // namespace
}  // namespace umbsim::acceptance
