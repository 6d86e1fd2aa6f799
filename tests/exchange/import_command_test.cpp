// `umbsim import` on logs of one drive in every form: all of them become the same recording, and it says what drive.py
// put into the robot.
#include <fmt/format.h>

#include <cmath>

#include "tests/exchange/data_folder.h"

namespace umbsim::acceptance {
namespace {

constexpr double kRounded_m = 2e-6;  // of printed poses
constexpr double kRounded_rad = 2e-6;

struct Form {
  const char* name;
  Words words;
};

const std::vector<Form>& forms() {
  static const std::vector<Form> all = {
      {"ticks and TUM", joined({data("ticks.csv"), "--truth-file", data("truth.tum")}, kTicks)},
      {"ticks and KITTI",
       joined({data("ticks.csv"), "--truth-file", data("truth.kitti"), "--times", data("times.txt")}, kTicks)},
      {"topic echo", {data("echo_joint_states.csv"), "--truth-file", data("echo_mocap.csv")}},
      {"PlotJuggler", {data("plotjuggler.csv")}},
      {"MCAP, zstd", {data("drive_zstd.mcap")}},
      {"MCAP, LZ4", {data("drive_lz4.mcap")}},
      {"MCAP, tf", {data("drive_tf.mcap")}},
      {"rosbag2 folder, SQLite", {data("drive_db3")}},
      {"rosbag2 file, SQLite", {data("drive_db3/drive_0.db3")}},
      {"ROS 1", {data("drive.bag")}},
      {"counts of one bag, truth of another", joined({data("ticks.csv"), "--truth-file", data("drive.bag")}, kTicks)}};
  return all;
}

Outcome import(const Desk& desk, const Words& words, const std::string& out = "out") {
  return desk.umbsim(joined(joined({"import"}, words), joined(kRobot, {"--out", out})));
}

TEST(Import, EveryFormBecomesTheSameRecording) {
  const Desk desk;
  std::map<std::string, std::vector<std::vector<double>>> counts, truth;
  for (const Form& form : forms()) {
    SCOPED_TRACE(form.name);
    fs::remove_all(desk.home / "out");
    const Outcome outcome = import(desk, form.words);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    for (const std::string& run : kRuns) {
      const auto rows = numbers_of(desk.home / "out/runs" / run / "encoders.csv");
      const auto poses = numbers_of(desk.home / "out/runs" / run / "truth.csv");
      if (!counts.count(run)) {
        counts[run] = rows;
        truth[run] = poses;
      }
      EXPECT_EQ(rows, counts[run]) << run;
      ASSERT_EQ(poses.size(), truth[run].size()) << run;
      for (std::size_t i = 0; i < poses.size(); ++i) {
        EXPECT_NEAR(poses[i][0], truth[run][i][0], 2e-9);
        for (const std::size_t k : {1u, 2u}) EXPECT_NEAR(poses[i][k], truth[run][i][k], kRounded_m) << run << " " << i;
        EXPECT_NEAR(poses[i][3], truth[run][i][3], kRounded_rad) << run << " " << i;
      }
    }
  }
}

// Against the source's own text: counts since the run's first row.
TEST(Import, CountsAreThoseOfTheSource) {
  const Desk desk;
  ASSERT_EQ(import(desk, forms()[0].words).code, 0);
  const json runs = json_of(desk.home / "out/import.json")["runs"];
  ASSERT_EQ(runs.size(), 4u);
  const auto source = numbers_of(data("ticks.csv"));
  for (const json& run : runs) {
    const auto rows = numbers_of(desk.home / "out/runs" / run["id"].get<std::string>() / "encoders.csv");
    std::size_t at = 0;
    while (source[at][0] - source[0][0] < run["from_s"].get<double>() - 1e-6) ++at;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      EXPECT_EQ(rows[i][1], source[at + i][1] - source[at][1]);
      EXPECT_EQ(rows[i][2], source[at + i][2] - source[at][2]);
    }
  }
}

TEST(Import, CalibrationFindsWhatTheRobotReallyIs) {
  const Desk desk;
  ASSERT_EQ(import(desk, {data("drive_zstd.mcap")}).code, 0);
  const Outcome outcome = desk.umbsim({"calibrate", "out", "--out", "calibrated"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json heading = json_of(desk.home / "calibrated/calibration.json")["calibration"]["heading"];
  constexpr double kNoise = 1e-3;  // 1 mrad of heading on 2 pi, and rows that end a little before the run does
  EXPECT_NEAR(heading["e_b"].get<double>(), 0.1616 / 0.160, kNoise);
  EXPECT_NEAR(heading["e_d"].get<double>(), 0.03309 / 0.03291, kNoise);
}

TEST(Import, ClocksAreComparedAndLeftAlone) {
  const Desk desk;
  ASSERT_EQ(import(desk, {data("drive.bag")}).code, 0);
  for (const json& run : json_of(desk.home / "out/import.json")["runs"]) {
    EXPECT_NEAR(run["clock"]["offset_s"].get<double>(), -0.04, 0.005) << "drive.py stamps the poses 40 ms late";
  }
  // The first pose of the log comes 40 ms after the first count, in the recording as in the bag.
  const auto rows = numbers_of(desk.home / "out/runs/cw-1/encoders.csv");
  const auto poses = numbers_of(desk.home / "out/runs/cw-1/truth.csv");
  EXPECT_NEAR(std::remainder(poses[0][0] - rows[0][0] - 0.04, 0.05), 0, 1e-6);
}

TEST(Import, DecimalCommasMillimetresMillisecondsAndWrappedDegrees) {
  const Desk desk;
  const Outcome outcome = import(desk, joined({data("german.csv")}, kTicks));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  expect_says(unwrapped(outcome.out), {"parted by ';'", "decimal comma", "ms", "4 turns unwrapped"});
  const auto poses = numbers_of(desk.home / "out/runs/ccw-1/truth.csv");
  EXPECT_NEAR(poses.back()[3] - poses.front()[3], 2 * M_PI, 0.2);
}

// The wheels of ticks.csv as a log in another unit: `per_turn` of them are a turn. `form`: what a row holds.
enum class Rows { sums, steps, within_a_turn, rates };

std::string wheels_in(double per_turn, Rows form) {
  const auto source = numbers_of(data("ticks.csv"));
  std::ifstream stamps(data("ticks.csv"));
  std::string line, text = "time_s,left,right\n";
  std::getline(stamps, line);
  for (std::size_t i = 0; i < source.size() && std::getline(stamps, line); ++i) {
    text += line.substr(0, line.find(','));
    for (const std::size_t k : {1u, 2u}) {
      const auto turned = [&](std::size_t at) { return per_turn * source[at][k] / 4096; };
      const std::size_t before = i > 0 ? i - 1 : i, after = std::min(i + 1, source.size() - 1);
      const double value = form == Rows::sums    ? turned(i)
                           : form == Rows::steps ? turned(i) - turned(before)
                           : form == Rows::within_a_turn
                               ? turned(i) - per_turn * std::floor(turned(i) / per_turn)
                               : (turned(after) - turned(before)) / (0.05 * double(after - before));
      text += fmt::format(",{:.12g}", value);
    }
    text += "\n";
  }
  return text;
}

TEST(Import, WheelsInAnyUnitAreTheSameTurns) {
  constexpr double kCircle_m = 2 * M_PI * 0.033;
  constexpr double kCount = 1;          // to which a recording rounds
  constexpr double kCountsAStep = 120;  // between two samples, and so of what speeds between them leave open
  struct Case {
    const char* unit;
    double per_turn;
    Rows form;
  };
  const Desk desk;
  ASSERT_EQ(import(desk, forms()[0].words).code, 0);
  const auto expected = numbers_of(desk.home / "out/runs/cw-1/encoders.csv");
  for (const Case& c : {Case{"rad", 2 * M_PI, Rows::sums}, Case{"deg", 360, Rows::sums}, Case{"rev", 1, Rows::sums},
                        Case{"m", kCircle_m, Rows::sums}, Case{"mm", 1000 * kCircle_m, Rows::sums},
                        Case{"cm", 100 * kCircle_m, Rows::sums}, Case{"ticks", 4096, Rows::steps},
                        Case{"mm", 1000 * kCircle_m, Rows::steps}, Case{"rad", 2 * M_PI, Rows::within_a_turn},
                        Case{"deg", 360, Rows::within_a_turn}, Case{"rad/s", 2 * M_PI, Rows::rates},
                        Case{"deg/s", 360, Rows::rates}, Case{"rpm", 60, Rows::rates},
                        Case{"m/s", kCircle_m, Rows::rates}, Case{"mm/s", 1000 * kCircle_m, Rows::rates}}) {
    SCOPED_TRACE(fmt::format("{} {}", c.unit, int(c.form)));
    desk.put("wheels.csv", wheels_in(c.per_turn, c.form));
    fs::remove_all(desk.home / "out");
    // Counts are seen to be what each sample added.
    Words words = joined({"wheels.csv", "--truth-file", data("truth.tum"), "--unit", c.unit}, kTicks);
    if (c.form == Rows::steps && c.per_turn != 4096) words = joined(words, {"--counts", "per-sample"});
    const Outcome outcome = import(desk, words);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.out.find("jumps unwrapped") != std::string::npos, c.form == Rows::within_a_turn) << outcome.out;
    const auto rows = numbers_of(desk.home / "out/runs/cw-1/encoders.csv");
    const double within = c.form == Rows::rates ? kCountsAStep : kCount;
    for (std::size_t i = 0; i < std::min(rows.size(), expected.size()); i += 20) {
      for (const std::size_t k : {1u, 2u}) EXPECT_NEAR(rows[i][k], expected[i][k], within) << i;
    }
    if (c.form != Rows::rates) {
      EXPECT_EQ(rows.size(), expected.size());
    }
    EXPECT_NEAR(double(rows.size()), double(expected.size()), 20);
  }
}

TEST(Import, ColumnsOfTheTruthMayBeNamed) {
  const Desk desk;
  const Words named = {data("german.csv"), "--x-column", "x [mm]", "--y-column", "y [mm]", "--heading-column", "7"};
  const Outcome wrong = import(desk, joined(named, kTicks));
  EXPECT_EQ(wrong.code, 2);
  EXPECT_NE(wrong.err.find("7"), std::string::npos) << wrong.err;
  ASSERT_EQ(import(desk, joined({data("german.csv")}, kTicks), "whole").code, 0);
  const Outcome outcome = import(
      desk, joined({data("german.csv"), "--x-column", "x [mm]", "--y-column", "5", "--heading-column", "heading [deg]"},
                   kTicks));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(numbers_of(desk.home / "out/runs/ccw-1/truth.csv"), numbers_of(desk.home / "whole/runs/ccw-1/truth.csv"));
}

TEST(Import, RunsAreCutByTimesOrStandstills) {
  const Desk desk;
  const Words source = {data("drive_db3")};
  ASSERT_EQ(import(desk, joined(source, {"--runs", data("runs.csv")}), "times").code, 0);
  ASSERT_EQ(import(desk, joined(source, {"--cut", "standstills"}), "still").code, 0);
  ASSERT_EQ(import(desk, joined(source, {"--cut", "none"}), "whole").code, 0);
  EXPECT_EQ(listing(desk.home / "times/runs"), (std::set<std::string>{"cw-1", "cw-2", "ccw-1", "ccw-2"}));
  EXPECT_EQ(listing(desk.home / "still/runs"), (std::set<std::string>{"run-1", "run-2", "run-3", "run-4"}));
  EXPECT_EQ(listing(desk.home / "whole/runs"), (std::set<std::string>{"run-1"}));
  EXPECT_EQ(json_of(desk.home / "times/import.json")["runs"][1]["from_s"], 26.98);
}

TEST(Import, ADryRunShowsAndWritesNothing) {
  const Desk desk;
  const Outcome outcome = desk.umbsim(joined({"import", data("drive_zstd.mcap"), "--dry-run"}, kRobot));
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  expect_says(unwrapped(outcome.out), {"cw-2", "squares of 0.5 m", "not used: /chatter (std_msgs/String)",
                                       "Nothing was written", "steps of 1/4096"});
  EXPECT_EQ(listing(desk.home), std::set<std::string>{});
}

TEST(Import, TheRobotMayComeFromItsUrdf) {
  const Desk desk;
  std::string urdf = text_of(std::string(UMBSIM_SOURCE_DIR) + "/robots/optiodom.urdf");
  desk.put("my robot.urdf", urdf);
  const Outcome outcome =
      desk.umbsim({"import", data("ticks.csv"), "--truth-file", data("truth.tum"), "--robot", "my robot.urdf",
                   "--ticks-per-revolution", "5213", "--wheelbase", "0.16", "--out", "out"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(fs::exists(desk.home / "out/my_robot.urdf"));
  expect_says(text_of(desk.home / "out/recording.yaml"),
              {"urdf: my_robot.urdf", "wheel_radius_m: 0.042", "wheelbase_m: 0.16"});
}

TEST(Import, ThePictureShowsEveryRun) {
  const Desk desk;
  ASSERT_EQ(import(desk, {data("drive.bag")}).code, 0);
  const std::string svg = text_of(desk.home / "out/paths.svg");
  std::size_t lines = 0;
  for (std::size_t at = svg.find("<polyline"); at != std::string::npos; at = svg.find("<polyline", at + 1)) ++lines;
  EXPECT_EQ(lines, 8u);
}

TEST(Import, MountAndUpAreTakenOut) {
  const Desk desk;
  for (const auto& [name, option, value] :
       {std::array{"looks_aside", "--mount", "0,0,90"}, std::array{"y_up", "--up", "+y"}}) {
    const Outcome outcome = import(desk, {data(std::string("spoiled/") + name + ".mcap"), option, value}, name);
    ASSERT_EQ(outcome.code, 0) << name << outcome.err;
    ASSERT_EQ(import(desk, {data("spoiled/good.mcap")}, std::string("good-") + name).code, 0);
    const auto poses = numbers_of(desk.home / name / "runs/run-1/truth.csv");
    const auto good = numbers_of(desk.home / (std::string("good-") + name) / "runs/run-1/truth.csv");
    ASSERT_EQ(poses.size(), good.size());
    for (std::size_t k = 1; k < 4; ++k) EXPECT_NEAR(poses.back()[k], good.back()[k], 1e-6) << name << k;
  }
}

}  // namespace
}  // namespace umbsim::acceptance
