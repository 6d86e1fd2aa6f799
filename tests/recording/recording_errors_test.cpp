#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "core/error.h"
#include "folder.h"
#include "recording/recording.h"

namespace umbsim {
namespace {

const std::string kYaml =
    "format: umbsim-recording/1\n"                                                 // 1
    "title: t\n"                                                                   // 2
    "robot:\n"                                                                     // 3
    "  wheel_radius_m: 0.075\n"                                                    // 4
    "  wheelbase_m: 0.34\n"                                                        // 5
    "  ticks_per_revolution: 2000\n"                                               // 6
    "path: {shape: square, side_m: 4}\n"                                           // 7
    "encoders: {rate_hz: 50}\n"                                                    // 8
    "truth: {kind: track}\n"                                                       // 9
    "runs:\n"                                                                      // 10
    "  - {id: a, direction: cw, encoders: runs/a/e.csv, truth: runs/a/t.csv}\n"    // 11
    "  - {id: b, direction: ccw, encoders: runs/b/e.csv, truth: runs/b/t.csv}\n";  // 12
const std::string kEncoders = "time_s,left_ticks,right_ticks\n0,0,0\n0.02,10,11\n0.04,20,22\n";
const std::string kTruth = "time_s,x_m,y_m,theta_rad\n0,0,0,0\n0.04,0.1,0.2,0.3\n";

void put_valid(const Folder& folder) {
  folder.put("recording.yaml", kYaml);
  for (const std::string run : {"a", "b"}) {
    folder.put("runs/" + run + "/e.csv", kEncoders);
    folder.put("runs/" + run + "/t.csv", kTruth);
  }
}

/// The message of reading, without the folder's name.
std::string message(const Folder& folder) {
  try {
    read_recording(folder.path());
  } catch (const InputError& error) {
    const std::string text = error.what();
    const std::string prefix = folder.path().string() + "/";
    return text.rfind(prefix, 0) == 0 ? text.substr(prefix.size()) : text;
  }
  return "no InputError";
}

/// The message after one piece of recording.yaml is replaced.
std::string message_of_yaml(const std::string& old_text, const std::string& new_text) {
  const Folder folder;
  put_valid(folder);
  std::string yaml = kYaml;
  const std::size_t place = yaml.find(old_text);
  if (place == std::string::npos) return "the test's text is not there: " + old_text;
  folder.put("recording.yaml", yaml.replace(place, old_text.size(), new_text));
  return message(folder);
}

std::string message_of_file(const std::string& name, const std::string& text) {
  const Folder folder;
  put_valid(folder);
  folder.put(name, text);
  return message(folder);
}

TEST(RecordingErrors, TheValidOneIsValid) {
  const Folder folder;
  put_valid(folder);
  EXPECT_EQ(message(folder), "no InputError");
}

TEST(RecordingErrors, KeysAndValues) {
  const std::vector<std::array<std::string, 3>> cases = {
      {"umbsim-recording/1", "umbsim-recording/2",
       "recording.yaml:1:9: format: 'umbsim-recording/2' is not known (must be 'umbsim-recording/1')"},
      {"title: t\n", "", "recording.yaml:1:1: title: this key is missing"},
      {"title: t\n", "title: t\nauthor: me\n",
       "recording.yaml:3:1: author: unknown key; one of: encoders, format, path, robot, runs, source, title, truth"},
      {"title: t\n", "title: t\ntitle: u\n", "recording.yaml:3:1: title: duplicate key (first on line 2)"},
      {"title: t\n", "title: [t]\n", "recording.yaml:2:8: title: expected text, got a list"},
      {"0.075", "-0.075", "recording.yaml:4:19: robot.wheel_radius_m: -0.075 is out of range (must be > 0 and <= 100)"},
      {"0.34", "340",
       "recording.yaml:5:16: robot.wheelbase_m: 340 is out of range (must be > 0 and <= 100, in metres: 0.34 if this is "
       "millimetres)"},
      {"2000", "many", "recording.yaml:6:25: robot.ticks_per_revolution: expected a number, got 'many'"},
      {"2000\n", "2000\n  urdf: ../a.urdf\n",
       "recording.yaml:7:9: robot.urdf: '../a.urdf' must be the name of a file in robots/ or beside the recording"},
      {"shape: square", "shape: sqare",
       "recording.yaml:7:15: path.shape: unknown value 'sqare'; did you mean 'square'? one of: square, circle, figure_eight, "
       "path, free"},
      {"side_m: 4", "side_m: 4, radius_m: 1", "recording.yaml:7:44: path.radius_m: only circles have a radius (shape is square)"},
      {"side_m: 4", "side_m: 4, waypoints_m: [[1, 0]]",
       "recording.yaml:7:47: path.waypoints_m: only a path has waypoints (shape is square)"},
      {"shape: square, side_m: 4", "shape: path, waypoints_m: [[1]]",
       "recording.yaml:7:35: path.waypoints_m[0]: a waypoint is two numbers, [x, y]"},
      {"shape: square", "shape: circle",
       "recording.yaml:7:31: path.side_m: only a square has a side (shape is circle)"},
      {", side_m: 4", "", "recording.yaml:7:7: path.side_m: this key is missing"},
      {"side_m: 4", "side_m: 4, turn: ark",
       "recording.yaml:7:40: path.turn: unknown value 'ark'; did you mean 'arc'? one of: in_place, arc"},
      {"rate_hz: 50", "rate_hz: 0",
       "recording.yaml:8:21: encoders.rate_hz: 0 is out of range (must be > 0 and <= 1000000)"},
      {"kind: track", "kind: track, position_sd_m: -1",
       "recording.yaml:9:37: truth.position_sd_m: -1 is out of range (must be >= 0 and <= 1000)"},
  };
  for (const auto& [old_text, new_text, expected] : cases) EXPECT_EQ(message_of_yaml(old_text, new_text), expected);
}

TEST(RecordingErrors, Runs) {
  const std::vector<std::array<std::string, 3>> cases = {
      {"id: b", "id: a", "recording.yaml:12:10: runs[1].id: 'a' is the id of an earlier run"},
      {"id: b", "id: ../b", "recording.yaml:12:10: runs[1].id: '../b' must not contain a path separator"},
      {"id: b", "id: ..", "recording.yaml:12:10: runs[1].id: '..' must not be '.' or contain '..'"},
      {"id: b", "id: \"\"", "recording.yaml:12:10: runs[1].id: '' must not be empty"},
      {"id: b, ", "", "recording.yaml:12:5: runs[1].id: this key is missing"},
      {"direction: ccw", "direction: left",
       "recording.yaml:12:24: runs[1].direction: unknown value 'left'; one of: cw, ccw, free"},
      {"runs/b/e.csv", "../e.csv",
       "recording.yaml:12:39: runs[1].encoders: '../e.csv' must stay inside the recording's folder"},
      {"runs/b/t.csv", "/etc/hostname",
       "recording.yaml:12:60: runs[1].truth: '/etc/hostname' must stay inside the recording's folder"},
      {"runs/b/t.csv", "runs/./a/t.csv",
       "recording.yaml:12:60: runs[1].truth: 'runs/./a/t.csv' is the file of runs[0].truth already"},
      {"id: b", "id: b, payload_kg: heavy", "recording.yaml:12:25: runs[1].payload_kg: expected a number, got 'heavy'"},
      {"id: b", "id: b, inner_wheel_bumps: 2.5",
       "recording.yaml:12:32: runs[1].inner_wheel_bumps: expected an integer, got '2.5'"},
      {"id: b", "id: b, bumps: [{x_m: 1, y_m: 0, height_m: 0.01}, {x_m: 1, y_m: 0}]",
       "recording.yaml:12:55: runs[1].bumps[1].height_m: this key is missing"},
      {"id: b", "id: b, bumps: [{x_m: 1, y_m: 0, height_mm: 1, height_m: 1}]",
       "recording.yaml:12:38: runs[1].bumps[0].height_mm: unknown key; did you mean 'height_m'? one of: height_m, x_m, "
       "y_m"},
  };
  for (const auto& [old_text, new_text, expected] : cases) EXPECT_EQ(message_of_yaml(old_text, new_text), expected);
  const std::string unknown = message_of_yaml("id: b", "id: b, speed_mps: 1");
  EXPECT_EQ(unknown.rfind("recording.yaml:12:13: runs[1].speed_mps: unknown key; ", 0), 0u) << unknown;
  const std::string runs = kYaml.substr(kYaml.find("runs:"));
  EXPECT_EQ(message_of_yaml(runs, "runs: []\n"), "recording.yaml:10:7: runs: must list at least one run");
}

TEST(RecordingErrors, EncoderRows) {
  const std::string head = "time_s,left_ticks,right_ticks\n0,0,0\n";
  const std::vector<std::array<std::string, 2>> cases = {
      {"", "runs/b/e.csv: the file is empty"},
      {"time_s,left,right\n0,0,0\n",
       "runs/b/e.csv:1:1: header 'time_s,left,right' must be 'time_s,left_ticks,right_ticks' or "
       "'time_s,left_ticks,right_ticks,left_command_radps,right_command_radps'"},
      {"time_s,left_ticks,right_ticks", "runs/b/e.csv: has 0 rows (must be >= 2)"},
      {head, "runs/b/e.csv: has 1 rows (must be >= 2)"},
      {head + "0.02,1.5,2\n", "runs/b/e.csv:3:6: left_ticks: '1.5' is not an integer"},
      {head + "0.02,1,\n", "runs/b/e.csv:3:8: right_ticks: '' is not an integer"},
      {head + "0.02,1,9007199254740993\n",
       "runs/b/e.csv:3:8: right_ticks: 9007199254740993 is out of range (must be within +-9007199254740992)"},
      {head + "nan,1,2\n", "runs/b/e.csv:3:1: time_s: 'nan' is not a finite number"},
      {head + "0.02 s,1,2\n", "runs/b/e.csv:3:1: time_s: '0.02 s' is not a number"},
      {head + "0,1,2\n", "runs/b/e.csv:3:1: time_s: 0 does not increase (must be > 0, the row before)"},
      {head + "0.02,1\n0.04,2,2\n", "runs/b/e.csv:3:6: the row has 2 of 3 columns; right_ticks is missing"},
      {head + "0.02,1,2,3\n", "runs/b/e.csv:3:8: the row has more than 3 columns"},
      {head + "0.02,1,2\n0.04,1", "runs/b/e.csv:4:6: the row is cut short: it does not end with a line break"},
      {head + "0.02,1,2\n0.04,1,23", "runs/b/e.csv:4:8: the row is cut short: it does not end with a line break"},
      {head + "\n0.02,1,2\n", "runs/b/e.csv:3:1: the row has 1 of 3 columns; left_ticks is missing"},
      {"time_s,left_ticks,right_ticks,left_command_radps,right_command_radps\n0,0,0,inf,0\n",
       "runs/b/e.csv:2:7: left_command_radps: 'inf' is not a finite number"},
  };
  for (const auto& [text, expected] : cases) EXPECT_EQ(message_of_file("runs/b/e.csv", text), expected);
}

TEST(RecordingErrors, TruthRows) {
  const std::string head = "time_s,x_m,y_m,theta_rad\n0,0,0,0\n";
  EXPECT_EQ(message_of_file("runs/b/t.csv", head + "1,0,0,-inf\n"),
            "runs/b/t.csv:3:7: theta_rad: '-inf' is not a finite number");
  EXPECT_EQ(message_of_file("runs/b/t.csv", head + "1,2e12,0,0\n"),
            "runs/b/t.csv:3:3: x_m: 2e12 is out of range (must be within +-1000000000000)");
  EXPECT_EQ(message_of_file("runs/b/t.csv", "time_s,x_m,y_m,theta_rad\n50,0,0,0\n60,1,0,0\n"),
            "recording.yaml:12:5: runs[1]: encoders (0 to 0.04 s) and truth (50 to 60 s) do not overlap in time");
  EXPECT_EQ(message_of_file("runs/b/t.csv",
                            "\x7f"
                            "ELF\n")
                .substr(0, 40),
            "runs/b/t.csv:1:1: header '\\x7fELF' must ");

  const Folder folder;
  put_valid(folder);
  std::string yaml = kYaml;
  folder.put("recording.yaml", yaml.replace(yaml.find("track"), 5, "endpoints"));
  folder.put("runs/b/t.csv", kTruth + "0.05,1,1,1\n");
  EXPECT_EQ(message(folder), "runs/b/t.csv: has 3 rows (must be 2, as truth.kind is endpoints)");
}

TEST(RecordingErrors, MissingFiles) {
  const Folder folder;
  EXPECT_EQ(message(folder), "recording.yaml: cannot be read: No such file or directory");
  put_valid(folder);
  std::filesystem::remove(folder.path() / "runs/b/t.csv");
  EXPECT_EQ(message(folder), "runs/b/t.csv: cannot be read: No such file or directory");
  std::filesystem::create_directory(folder.path() / "runs/b/t.csv");
  EXPECT_EQ(message(folder), "runs/b/t.csv: cannot be read: it is a directory");
  EXPECT_THROW(read_recording(folder.path() / "recording.yaml"), InputError);
}

/// The message of the RunError that writing throws.
std::string write_message(const Recording& recording, const std::filesystem::path& directory) {
  try {
    write_recording(recording, directory);
  } catch (const RunError& error) {
    return error.what();
  }
  return "no RunError";
}

Recording small_recording() {
  Recording recording;
  recording.robot = {"", 0.1, 0.3, 1000};
  recording.path.side_m = 1;
  recording.encoder_rate_hz = 10;
  RecordedRun run;
  run.id = "a";
  run.direction = "cw";
  run.encoders = {{0, 0, 0, 0, 0}, {1, 1, 1, 0, 0}};
  run.truth = {{0, {}}, {1, {}}};
  recording.runs = {run};
  return recording;
}

TEST(RecordingErrors, WritingToAFullDisk) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full on this system";
  const Folder folder;
  std::filesystem::create_directories(folder.path() / "runs/a");
  std::filesystem::create_symlink("/dev/full", folder.path() / "runs/a/truth.csv");
  const std::string text = write_message(small_recording(), folder.path());
  EXPECT_NE(text.find("truth.csv: cannot be written completely: No space left on device"), std::string::npos) << text;
}

TEST(RecordingErrors, WritingWhereNoFolderCanBe) {
  const Folder folder;
  folder.put("runs", "a file");
  EXPECT_NE(write_message(small_recording(), folder.path()).find("cannot be created"), std::string::npos);
}

TEST(RecordingErrors, WritingWhatCouldNotBeRead) {
  const Folder folder;
  Recording recording = small_recording();
  recording.runs[0].truth[1].X_WB.y_m = std::nan("");
  EXPECT_EQ(write_message(recording, folder.path()), "run 'a': truth.csv has a non-finite value at 1 s");
  recording = small_recording();
  recording.robot.wheelbase_m = std::numeric_limits<double>::infinity();
  EXPECT_EQ(write_message(recording, folder.path()), "recording.yaml: wheelbase_m: inf is not a finite number");
  recording = small_recording();
  recording.runs[0].id = "../a";
  EXPECT_EQ(write_message(recording, folder.path()), "run id '../a' must not contain a path separator");
  recording = small_recording();
  recording.runs.push_back(recording.runs[0]);
  EXPECT_EQ(write_message(recording, folder.path()), "two runs have the id 'a'");
}

}  // namespace
}  // namespace umbsim
