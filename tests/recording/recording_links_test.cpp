// A recording comes from others: what it names must lie in its own folder, links included.
#include <gtest/gtest.h>

#include <filesystem>

#include "core/error.h"
#include "folder.h"
#include "recording/recording.h"

namespace umbsim {
namespace {

namespace fs = std::filesystem;

const std::string kSecret = "the_first_line_of_a_private_file";

/// `mine/` with a secret beside `theirs/`, a recording of one run.
class Links : public testing::Test {
 protected:
  Links() {
    folder_.put("mine/secret", kSecret + "\n");
    folder_.put("mine/encoders.csv", "time_s,left_ticks,right_ticks\n0,0,0\n0.02,10,11\n0.04,20,22\n");
    folder_.put("theirs/recording.yaml", yaml("runs/a/encoders.csv"));
    folder_.put("theirs/runs/a/encoders.csv", folder_.get("mine/encoders.csv"));
    folder_.put("theirs/runs/a/truth.csv", "time_s,x_m,y_m,theta_rad\n0,0,0,0\n0.04,0.1,0.2,0.3\n");
  }

  static std::string yaml(const std::string& encoders, const std::string& robot = "") {
    return "format: umbsim-recording/1\ntitle: t\nrobot: {" + robot +
           "wheel_radius_m: 0.075, wheelbase_m: 0.34, ticks_per_revolution: 2000}\n"
           "path: {shape: square, side_m: 4}\nencoders: {rate_hz: 50}\ntruth: {kind: track}\nruns:\n"
           "  - {id: a, direction: cw, encoders: " +
           encoders + ", truth: runs/a/truth.csv}\n";
  }

  fs::path theirs() const { return folder_.path() / "theirs"; }

  /// Replaces a file of the recording by a link.
  void link(const std::string& name, const fs::path& target) const {
    fs::remove_all(theirs() / name);
    fs::create_symlink(target, theirs() / name);
  }

  void expect_refused(const std::string& says) const {
    try {
      read_recording(theirs());
      ADD_FAILURE() << "was read";
    } catch (const InputError& e) {
      const std::string message = e.what();
      EXPECT_NE(message.find(says), std::string::npos) << message;
      EXPECT_NE(message.find("leaves the recording's folder"), std::string::npos) << message;
      EXPECT_EQ(message.find(kSecret), std::string::npos) << message;
    }
  }

  Folder folder_;
};

TEST_F(Links, AFileElsewhereIsNeitherReadNorQuoted) {
  for (const fs::path& target :
       {fs::path("../../../mine/secret"), folder_.path() / "mine/secret", folder_.path() / "mine/encoders.csv"}) {
    link("runs/a/encoders.csv", target);
    expect_refused("recording.yaml:8:");
  }
}

TEST_F(Links, AFolderElsewhereNeither) {
  fs::create_directories(folder_.path() / "mine/a");
  fs::copy(theirs() / "runs/a", folder_.path() / "mine/a");
  link("runs", folder_.path() / "mine");
  expect_refused("runs[0].encoders: 'runs/a/encoders.csv' is a link");
}

TEST_F(Links, ALinkToALinkThatLeavesNeither) {
  fs::create_symlink("../mine/secret", theirs() / "inner");
  link("runs/a/truth.csv", "../../inner");
  expect_refused("runs[0].truth");
}

TEST_F(Links, RecordingYamlItselfNeither) {
  link("recording.yaml", "../mine/secret");
  expect_refused("recording.yaml: is a link");
}

TEST_F(Links, TheRobotNeither) {
  folder_.put("theirs/recording.yaml", yaml("runs/a/encoders.csv", "urdf: robot.urdf, "));
  link("robot.urdf", "../mine/secret");
  expect_refused("robot.urdf: 'robot.urdf' is a link");
}

TEST_F(Links, AFolderWhoseNameBeginsAlikeIsAnother) {
  folder_.put("theirs-too/secret", kSecret + "\n");
  link("runs/a/encoders.csv", "../../../theirs-too/secret");
  expect_refused("runs[0].encoders");
}

TEST_F(Links, InsideTheFolderTheyAreFollowed) {
  fs::rename(theirs() / "runs/a/encoders.csv", theirs() / "ticks.csv");
  link("runs/a/encoders.csv", "../../ticks.csv");
  EXPECT_EQ(read_recording(theirs()).runs.at(0).encoders.size(), 3u);
}

TEST_F(Links, TheFolderItselfMayBeOne) {
  fs::create_directory_symlink("theirs", folder_.path() / "link");
  EXPECT_EQ(read_recording(folder_.path() / "link").runs.size(), 1u);
  EXPECT_EQ(read_recording(folder_.path() / "link/").runs.size(), 1u);
}

// Two runs from one file are one run counted twice.
TEST_F(Links, TwoNamesOfOneFileAreFoundOut) {
  fs::create_symlink("encoders.csv", theirs() / "runs/a/again.csv");
  folder_.put("theirs/recording.yaml",
              yaml("runs/a/encoders.csv") +
                  "  - {id: b, direction: cw, encoders: runs/a/again.csv, truth: runs/a/truth.csv}\n");
  try {
    read_recording(theirs());
    ADD_FAILURE() << "was read";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("is the file of runs[0].encoders already"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace umbsim
