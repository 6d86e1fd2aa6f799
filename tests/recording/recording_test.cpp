#include "recording/recording.h"

#include <gtest/gtest.h>

#include <chrono>

#include "core/error.h"
#include "core/text/yaml_reader.h"
#include "folder.h"
#include "recording/names.h"

namespace umbsim {
namespace {

/// A recording that uses every key of the format.
Recording full_recording() {
  Recording recording;
  recording.title = "Square: \"4 m\" #1, 50 \\ % of\nspeed";
  recording.source = "null";
  recording.robot = {"labmate.urdf", 0.075, 0.34, 2796.8};
  recording.path = {"square", 4, {}, {}, "arc", 0.4, 0.2, 0.7, 0.25, 1.5};
  recording.encoder_rate_hz = 50;
  recording.truth_position_sd_m = 3e-5;
  recording.truth_heading_sd_rad = 0.0003;
  RecordedRun plain;
  plain.id = "cw-1";
  plain.direction = "cw";
  plain.encoders = {{0, 0, 0, 0, 0}, {0.02, 12, -7, 0, 0}, {0.04, 9007199254740992, 1, 0, 0}};
  plain.truth = {{0, {0, 0, 0}}, {0.1, {0.1 + 0.2, -1e-9, 1.5707963267948966}}};
  RecordedRun special = plain;
  special.id = "ccw 2: #";
  special.direction = "ccw";
  special.start_heading_rad = 1.5708;
  special.linear_speed_mps = 0.4;
  special.turn = "in_place";
  special.turn_radius_m = 0.3;
  special.payload_kg = 15;
  special.bumps = {{2, -0.17, 0.006}, {1, 0, 0.01}};
  special.inner_wheel_bumps = 10;
  special.has_commands = true;
  special.encoders[1].left_command_radps = 1.0 / 3;
  special.encoders[2].right_command_radps = -2.5;
  recording.runs = {plain, special};
  return recording;
}

void expect_same_rows(const RecordedRun& a, const RecordedRun& b) {
  constexpr double kRounding = 0.5e-9;  // values are written to 1e-9
  EXPECT_EQ(a.has_commands, b.has_commands);
  ASSERT_EQ(a.encoders.size(), b.encoders.size());
  for (std::size_t i = 0; i < a.encoders.size(); ++i) {
    EXPECT_NEAR(a.encoders[i].time_s, b.encoders[i].time_s, kRounding);
    EXPECT_EQ(a.encoders[i].left_ticks, b.encoders[i].left_ticks);
    EXPECT_EQ(a.encoders[i].right_ticks, b.encoders[i].right_ticks);
    EXPECT_NEAR(a.encoders[i].left_command_radps, b.encoders[i].left_command_radps, kRounding);
    EXPECT_NEAR(a.encoders[i].right_command_radps, b.encoders[i].right_command_radps, kRounding);
  }
  ASSERT_EQ(a.truth.size(), b.truth.size());
  for (std::size_t i = 0; i < a.truth.size(); ++i) {
    EXPECT_NEAR(a.truth[i].time_s, b.truth[i].time_s, kRounding);
    EXPECT_NEAR(a.truth[i].X_WB.x_m, b.truth[i].X_WB.x_m, kRounding);
    EXPECT_NEAR(a.truth[i].X_WB.y_m, b.truth[i].X_WB.y_m, kRounding);
    EXPECT_NEAR(a.truth[i].X_WB.theta_rad, b.truth[i].X_WB.theta_rad, kRounding);
  }
}

void expect_same_run(const RecordedRun& a, const RecordedRun& b) {
  EXPECT_EQ(a.id, b.id);
  EXPECT_EQ(a.direction, b.direction);
  EXPECT_EQ(a.start_heading_rad, b.start_heading_rad);
  EXPECT_EQ(a.linear_speed_mps, b.linear_speed_mps);
  EXPECT_EQ(a.turn, b.turn);
  EXPECT_EQ(a.turn_radius_m, b.turn_radius_m);
  EXPECT_EQ(a.payload_kg, b.payload_kg);
  EXPECT_EQ(a.inner_wheel_bumps, b.inner_wheel_bumps);
  ASSERT_EQ(a.bumps.size(), b.bumps.size());
  for (std::size_t i = 0; i < a.bumps.size(); ++i) {
    EXPECT_EQ(a.bumps[i].x_m, b.bumps[i].x_m);
    EXPECT_EQ(a.bumps[i].y_m, b.bumps[i].y_m);
    EXPECT_EQ(a.bumps[i].height_m, b.bumps[i].height_m);
  }
  expect_same_rows(a, b);
}

void expect_same_path(const RecordedPath& a, const RecordedPath& b) {
  EXPECT_EQ(a.shape, b.shape);
  EXPECT_EQ(a.side_m, b.side_m);
  EXPECT_EQ(a.turn, b.turn);
  EXPECT_EQ(a.turn_radius_m, b.turn_radius_m);
  EXPECT_EQ(a.linear_speed_mps, b.linear_speed_mps);
  EXPECT_EQ(a.angular_speed_radps, b.angular_speed_radps);
  EXPECT_EQ(a.linear_acceleration_mps2, b.linear_acceleration_mps2);
  EXPECT_EQ(a.angular_acceleration_radps2, b.angular_acceleration_radps2);
}

TEST(Recording, WriteThenReadIsTheSame) {
  const Folder folder;
  const Recording written = full_recording();
  write_recording(written, folder.path());
  const Recording read = read_recording(folder.path());
  EXPECT_EQ(read.title, written.title);
  EXPECT_EQ(read.source, written.source);
  EXPECT_EQ(read.robot.urdf, written.robot.urdf);
  EXPECT_EQ(read.robot.wheel_radius_m, written.robot.wheel_radius_m);
  EXPECT_EQ(read.robot.wheelbase_m, written.robot.wheelbase_m);
  EXPECT_EQ(read.robot.ticks_per_revolution, written.robot.ticks_per_revolution);
  expect_same_path(read.path, written.path);
  EXPECT_EQ(read.encoder_rate_hz, written.encoder_rate_hz);
  EXPECT_EQ(read.truth_kind, written.truth_kind);
  EXPECT_EQ(read.truth_position_sd_m, written.truth_position_sd_m);
  EXPECT_EQ(read.truth_heading_sd_rad, written.truth_heading_sd_rad);
  ASSERT_EQ(read.runs.size(), written.runs.size());
  for (std::size_t i = 0; i < read.runs.size(); ++i) expect_same_run(read.runs[i], written.runs[i]);
}

TEST(Recording, CirclesAndPathsKeepWhatWasDriven) {
  for (const char* shape : {"circle", "figure_eight", "path"}) {
    const Folder folder;
    Recording written = full_recording();
    written.path = {};
    written.path.shape = shape;
    if (std::string(shape) == "path") {
      written.path.waypoints = {{2, 0}, {1.5, -0.25}};
    } else {
      written.path.radius_m = 0.75;
    }
    write_recording(written, folder.path());
    const RecordedPath read = read_recording(folder.path()).path;
    expect_same_path(read, written.path);
    EXPECT_EQ(read.radius_m, written.path.radius_m);
    ASSERT_EQ(read.waypoints.size(), written.path.waypoints.size());
    for (std::size_t i = 0; i < read.waypoints.size(); ++i) {
      EXPECT_EQ(read.waypoints[i].x_m, written.path.waypoints[i].x_m);
      EXPECT_EQ(read.waypoints[i].y_m, written.path.waypoints[i].y_m);
    }
  }
}

TEST(Recording, WrittenAgainTheBytesAreTheSame) {
  const Folder folder;
  for (const char* name : {"first", "second"}) std::filesystem::create_directory(folder.path() / name);
  write_recording(full_recording(), folder.path() / "first");
  write_recording(read_recording(folder.path() / "first"), folder.path() / "second");
  for (const std::string name : {"recording.yaml", "runs/cw-1/truth.csv", "runs/ccw 2: #/encoders.csv"}) {
    EXPECT_FALSE(folder.get("first/" + name).empty()) << name;
    EXPECT_EQ(folder.get("first/" + name), folder.get("second/" + name)) << name;
  }
}

// The robot goes where the recording goes.
TEST(Recording, CarriesItsRobot) {
  const Folder folder;
  for (const char* name : {"first", "second"}) std::filesystem::create_directory(folder.path() / name);
  Recording recording = full_recording();
  recording.robot.urdf_text = "<robot name=\"r\"/>\n";
  recording.robot.left_joint = "left wheel: #1";
  recording.robot.right_joint = "right_wheel";
  write_recording(recording, folder.path() / "first");
  const Recording read = read_recording(folder.path() / "first");
  EXPECT_EQ(read.robot.urdf_text, recording.robot.urdf_text);
  EXPECT_EQ(read.robot.left_joint, recording.robot.left_joint);
  EXPECT_EQ(read.robot.right_joint, recording.robot.right_joint);
  write_recording(read, folder.path() / "second");
  for (const char* name : {"labmate.urdf", "recording.yaml"})
    EXPECT_EQ(folder.get(std::string("first/") + name), folder.get(std::string("second/") + name)) << name;
  EXPECT_EQ(folder.get("first/labmate.urdf"), recording.robot.urdf_text);
}

// An older recording names a file of robots/, which is not its own.
TEST(Recording, WithoutItsRobotNoneIsWritten) {
  const Folder folder;
  write_recording(full_recording(), folder.path());
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "labmate.urdf"));
  EXPECT_TRUE(read_recording(folder.path()).robot.urdf_text.empty());
}

TEST(Recording, ACopyOfARobotGetsANameThatNothingElseHas) {
  EXPECT_EQ(urdf_copy_name("/a/b/labmate.urdf"), "labmate.urdf");
  EXPECT_EQ(urdf_copy_name("recording.yaml"), "recording.yaml.urdf");
  EXPECT_EQ(urdf_copy_name("my robot\\2: \xc3\xbc.urdf"), "my_robot_2____.urdf");
}

TEST(Recording, FilesLookLikeTheFormat) {
  const Folder folder;
  write_recording(full_recording(), folder.path());
  EXPECT_EQ(folder.get("runs/cw-1/encoders.csv"),
            "time_s,left_ticks,right_ticks\n0,0,0\n0.02,12,-7\n0.04,9007199254740992,1\n");
  EXPECT_EQ(folder.get("runs/cw-1/truth.csv"), "time_s,x_m,y_m,theta_rad\n0,0,0,0\n0.1,0.3,-1e-09,1.570796327\n");
  EXPECT_EQ(folder.get("runs/ccw 2: #/encoders.csv"),
            "time_s,left_ticks,right_ticks,left_command_radps,right_command_radps\n"
            "0,0,0,0,0\n0.02,12,-7,0.333333333,0\n0.04,9007199254740992,1,0,-2.5\n");
  const std::string yaml = folder.get("recording.yaml");
  EXPECT_NE(yaml.find("truth:\n  kind: track\n  position_sd_m: 3.0e-05\n"), std::string::npos) << yaml;
  EXPECT_NE(yaml.find("\n  - {id: cw-1, direction: cw, encoders: runs/cw-1/encoders.csv, truth: runs/cw-1/truth.csv}"),
            std::string::npos)
      << yaml;
}

TEST(Recording, AwkwardTitlesSurvive) {
  for (const std::string title :
       {"",  " ",  "true", "12", "1e5", "- a", "a: b", "a #b",      "{x}",       "it's", "\"", "\\n", "tab\t",
        "~", "*a", "&a",   "!t", "%d",  "@x",  "`",    "Länge 4 m", "trailing ", "a,b",  "?",  "|"}) {
    const Folder folder;
    Recording recording = full_recording();
    recording.title = title;
    write_recording(recording, folder.path());
    EXPECT_EQ(read_recording(folder.path()).title, title);
  }
}

TEST(Recording, OptionalKeysMayBeAbsent) {
  const Folder folder;
  folder.put("recording.yaml",
             "format: umbsim-recording/1\ntitle: by hand\n"
             "robot: {wheel_radius_m: 0.075, wheelbase_m: 0.34, ticks_per_revolution: 2000}\n"
             "path: {shape: circle}\nencoders: {rate_hz: 50}\ntruth: {kind: endpoints}\n"
             "runs:\n  - {id: one, direction: ccw, encoders: e.csv, truth: ./t.csv}\n");
  folder.put("e.csv", "time_s,left_ticks,right_ticks\r\n0.0,0,0\r\n1.0,5,-6\r\n");
  folder.put("t.csv", "time_s,x_m,y_m,theta_rad\n0,0,0,0\n1,1e-3,-2,3\n");
  const Recording recording = read_recording(folder.path());
  EXPECT_TRUE(recording.robot.urdf.empty());
  EXPECT_EQ(recording.path.turn, "in_place");
  EXPECT_FALSE(recording.path.linear_speed_mps);
  const RecordedRun& run = recording.runs.at(0);
  EXPECT_FALSE(run.has_commands);
  EXPECT_FALSE(run.start_heading_rad || run.turn || run.payload_kg || run.inner_wheel_bumps);
  EXPECT_EQ(run.encoders.at(1).right_ticks, -6) << "Windows line breaks";
  EXPECT_EQ(run.truth.at(1).X_WB.x_m, 1e-3);
}

TEST(Recording, WritingIsFast) {
  constexpr int kRuns = 10, kRows = 5000;
  constexpr double kLimitS = 2;  // far above the 0.05 s wanted: sanitizers and busy machines
  Recording recording = full_recording();
  RecordedRun run = recording.runs[1];
  run.encoders.clear();
  run.truth.clear();
  for (int i = 0; i < kRows; ++i) {
    const double t = i * 0.02;
    run.encoders.push_back({t, i * 7, i * 8, std::sin(t), std::cos(t)});
    run.truth.push_back({t, {t * std::sin(t), t * std::cos(t), t / 3}});
  }
  recording.runs.clear();
  for (int i = 0; i < kRuns; ++i) {
    run.id = "cw-" + std::to_string(i);
    recording.runs.push_back(run);
  }
  const Folder folder;
  const auto seconds_of = [](const auto& work) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  const double write_s = seconds_of([&] { write_recording(recording, folder.path()); });
  const double read_s = seconds_of([&] { EXPECT_EQ(read_recording(folder.path()).runs.size(), std::size_t(kRuns)); });
  EXPECT_LT(write_s, kLimitS);
  EXPECT_LT(read_s, kLimitS);
  RecordProperty("write_ms", int(write_s * 1e3));
  RecordProperty("read_ms", int(read_s * 1e3));
  std::printf("write %.1f ms, read %.1f ms\n", write_s * 1e3, read_s * 1e3);
}

}  // namespace
}  // namespace umbsim
