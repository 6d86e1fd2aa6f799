// `umbsim export`: what was written is read again by other means, and imports to the same numbers.
#include <cmath>

#include "tests/exchange/data_folder.h"

namespace umbsim::acceptance {
namespace {

/// A desk with the imported log of drive.py, its robot and its calibration.
struct Lab : Desk {
  Lab() {
    must({"import", data("drive_zstd.mcap"), "--robot", data("robot.urdf"), "--out", "mine"});
    must({"calibrate", "mine", "--method", "heading", "--out", "calibrated"});
  }
  void must(const Words& words) const {
    const Outcome outcome = umbsim(words);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
  }
  fs::path exported(const std::string& from, const std::string& to, const Words& more = {}) const {
    must(joined({"export", from, "--to", to, "--out", to}, more));
    return home / to;
  }
};

/// The number behind "key: ".
double number_at(const std::string& text, const std::string& key) {
  const std::size_t at = text.find(key + ": ");
  EXPECT_NE(at, std::string::npos) << key;
  return at == std::string::npos ? NAN : std::stod(text.substr(at + key.size() + 2));
}

// Counts and poses of all runs as they were; `rounded`: of poses.
void expect_same_runs(const fs::path& a, const fs::path& b, double rounded) {
  for (const std::string& run : kRuns) {
    SCOPED_TRACE(run);
    const auto counts = numbers_of(a / "runs" / run / "encoders.csv"),
               again = numbers_of(b / "runs" / run / "encoders.csv");
    ASSERT_EQ(counts.size(), again.size());
    for (std::size_t i = 0; i < counts.size(); ++i) {
      EXPECT_NEAR(counts[i][0], again[i][0], 2e-9);
      EXPECT_EQ(counts[i][1], again[i][1]);
      EXPECT_EQ(counts[i][2], again[i][2]);
    }
    const auto poses = numbers_of(a / "runs" / run / "truth.csv"),
               again_poses = numbers_of(b / "runs" / run / "truth.csv");
    ASSERT_EQ(poses.size(), again_poses.size());
    for (std::size_t i = 0; i < poses.size(); ++i) {
      for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(poses[i][k], again_poses[i][k], rounded) << i << " " << k;
    }
  }
}

constexpr double kLastDigit = 3e-9;  // of what recordings round to 1e-9

TEST(Export, McapImportsToTheSameNumbers) {
  const Lab lab;
  const fs::path bag = lab.exported("mine", "mcap");
  EXPECT_EQ(listing(bag), (std::set<std::string>{"mine_0.mcap", "metadata.yaml", "runs.csv", "provenance.json"}));
  lab.must({"import", bag.string(), "--robot", data("robot.urdf"), "--runs", (bag / "runs.csv").string(),
            "--keep-frame", "--out", "back"});
  expect_same_runs(lab.home / "mine", lab.home / "back", kLastDigit);
}

// The odometry was made of the counts: turned back it must be them.
TEST(Export, OdometryTurnsBackIntoTheCounts) {
  const Lab lab;
  const fs::path bag = lab.exported("mine", "mcap");
  lab.must({"import", bag.string(), "--encoders", "/odom", "--robot", data("robot.urdf"), "--ticks-per-revolution",
            "4096", "--runs", (bag / "runs.csv").string(), "--keep-frame", "--out", "back"});
  expect_same_runs(lab.home / "mine", lab.home / "back", kLastDigit);
}

TEST(Export, CsvImportsToTheSameNumbers) {
  const Lab lab;
  const fs::path csv = lab.exported("mine", "csv");
  lab.must({"import", (csv / "samples.csv").string(), "--robot", data("robot.urdf"), "--ticks-per-revolution", "4096",
            "--runs", (csv / "runs.csv").string(), "--keep-frame", "--out", "back"});
  expect_same_runs(lab.home / "mine", lab.home / "back", kLastDigit);
}

// Of a simulated run, with the wheels' commands.
TEST(Export, CommandsComeBackFromCsv) { expect_commands_come_back("csv", "out/samples.csv"); }

TEST(Export, TumImportsToTheSameTruth) {
  const Lab lab;
  const fs::path tum = lab.exported("mine", "tum");
  EXPECT_EQ(listing(tum).size(), 2 * kRuns.size() + 1);
  const auto poses = numbers_of(lab.home / "mine/runs/cw-1/truth.csv");
  std::istringstream lines(text_of(tum / "cw-1.truth.tum"));
  for (const auto& pose : poses) {
    double t = 0, x = 0, y = 0, z = 0, qx = 0, qy = 0, qz = 0, qw = 0;
    lines >> t >> x >> y >> z >> qx >> qy >> qz >> qw;
    EXPECT_NEAR(t, pose[0], 1e-9);
    EXPECT_NEAR(x, pose[1], 1e-9);
    EXPECT_NEAR(y, pose[2], 1e-9);
    EXPECT_NEAR(std::remainder(2 * std::atan2(qz, qw) - pose[3], 2 * M_PI), 0, 1e-9);
  }
  lab.must({"import", data("ticks.csv"), "--truth-file", data("truth.tum"), "--robot", data("robot.urdf"),
            "--ticks-per-revolution", "4096", "--out", "other"});
}

TEST(Export, Ros2ControlHoldsTheCalibration) {
  const Lab lab;
  const std::string yaml = text_of(lab.exported("calibrated", "ros2_control", {"--robot", data("robot.urdf")}) /
                                   "diff_drive_controller.yaml");
  const json o = json_of(lab.home / "calibrated/calibration.json")["odometry"];
  const double radius = number_at(yaml, "wheel_radius"), separation = number_at(yaml, "wheel_separation");
  EXPECT_NEAR(radius, 0.033, 1e-9);
  EXPECT_NEAR(separation, 0.16, 1e-9);
  EXPECT_NEAR(number_at(yaml, "wheel_separation_multiplier") * separation, o["wheelbase_m"].get<double>(), 1e-9);
  EXPECT_NEAR(number_at(yaml, "left_wheel_radius_multiplier") * radius, o["left_radius_m"].get<double>(), 1e-9);
  EXPECT_NEAR(number_at(yaml, "right_wheel_radius_multiplier") * radius, o["right_radius_m"].get<double>(), 1e-9);
  expect_says(yaml, {"diff_drive_controller:\n  ros__parameters:\n", "left_wheel_names: [\"wheel_left_joint\"]", "k_L",
                     "form) on"});
  // The truth of drive.py lies in the intervals: 0.1616 / 0.16, 0.03291 / 0.033, 0.03309 / 0.033.
  for (const auto& [key, truth] :
       {std::pair{"wheel_separation_multiplier", 1.01}, std::pair{"left_wheel_radius_multiplier", 0.9972727},
        std::pair{"right_wheel_radius_multiplier", 1.0027273}}) {
    const std::size_t at = yaml.find("95 %: ", yaml.find(key));
    ASSERT_NE(at, std::string::npos);
    double low = 0, high = 0;
    ASSERT_EQ(std::sscanf(yaml.c_str() + at, "95 %%: %lf to %lf", &low, &high), 2);
    EXPECT_LT(low, truth) << key;
    EXPECT_GT(high, truth) << key;
    EXPECT_LT(high - low, 0.01) << key;
  }
  const std::size_t diagonal = yaml.find("pose_covariance_diagonal: [");
  ASSERT_NE(diagonal, std::string::npos) << yaml;
  double xx = 0, yy = 0, zz = 0, rr = 0, pp = 0, hh = 0;
  ASSERT_EQ(std::sscanf(yaml.c_str() + diagonal, "pose_covariance_diagonal: [%lf, %lf, %lf, %lf, %lf, %lf]", &xx, &yy,
                        &zz, &rr, &pp, &hh),
            6);
  // After s = 1 m straight with k on both wheels: var(theta) = 2 k^2 s / b^2, var(x) = k^2 s / 2, var(y) = var(theta)
  // s^2 / 3.
  const double b = 0.1616;
  EXPECT_NEAR(xx / (hh * b * b / 4), 1, 0.01);
  EXPECT_NEAR(yy / (hh / 3), 1, 0.02);
}

// A calibration by a method that has no factors of its own: the recording says what was believed.
TEST(Export, OtherMethodsBringTheirIntervals) {
  const Lab lab;
  json j = json_of(lab.home / "calibrated/calibration.json");
  const double base = j["odometry"]["wheelbase_m"];
  j["method"] = "likelihood";
  j["comparison"]["methods"] = {{{"name", "likelihood"},
                                 {"wheelbase_m", {{"value", base}, {"ci95", {base - 0.0016, base + 0.0016}}}},
                                 {"left_m_per_sqrt_m", {{"value", 2e-4}}},
                                 {"right_m_per_sqrt_m", {{"value", 2e-4}}}}};
  lab.put("calibrated/calibration.json", j.dump());
  const std::string yaml = text_of(lab.exported("calibrated", "ros2_control") / "diff_drive_controller.yaml");
  EXPECT_NEAR(number_at(yaml, "wheel_separation_multiplier"), base / 0.16, 1e-8);
  expect_says(yaml, {"95 %: 1.000041 to 1.020041", "k_L 0.0002", "the fit of likelihood", "keep your own",
                     // k^2 s / 2 after s = 1 m
                     "pose_covariance_diagonal: [2.000e-08"});
}

TEST(Export, UrdfHasTheCalibratedWheels) {
  const Lab lab;
  const fs::path urdf = lab.exported("calibrated", "urdf", {"--robot", data("robot.urdf")}) / "robot.urdf";
  const json o = json_of(lab.home / "calibrated/calibration.json")["odometry"];
  // Read again as a robot: the importer's header.
  const Outcome outcome = lab.umbsim({"import", data("drive_zstd.mcap"), "--robot", urdf.string(), "--out", "again"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::string yaml = text_of(lab.home / "again/recording.yaml");
  const double base = o["wheelbase_m"];
  EXPECT_NEAR(number_at(yaml, "wheelbase_m"), base, 1e-8);
  EXPECT_NEAR(number_at(yaml, "wheel_radius_m"),
              (o["left_radius_m"].get<double>() + o["right_radius_m"].get<double>()) / 2, 1e-8);
}

TEST(Export, SdfNamesJointsAndNumbers) {
  const Lab lab;
  const std::string sdf = text_of(lab.exported("mine", "sdf") / "diff_drive.sdf");
  expect_says(sdf, {"gz::sim::systems::DiffDrive", "<left_joint>wheel_left_joint</left_joint>",
                    "<wheel_separation>0.160000000</wheel_separation>", "<wheel_radius>0.033000000</wheel_radius>",
                    "<mu>0.9</mu>"});
}

/// The number between "<key>" and "</key>".
double element_at(const std::string& text, const std::string& key) {
  const std::size_t at = text.find("<" + key + ">");
  EXPECT_NE(at, std::string::npos) << key;
  return at == std::string::npos ? NAN : std::stod(text.substr(at + key.size() + 2));
}

// Gazebo's slip is a speed per force. A creep C does as much at the twin's speed v under half of the weight:
// 2 C v / (m g), to which the twin's own slip comes.
TEST(Export, SdfSlipsAsTheTwinDoes) {
  const Lab lab;
  fs::create_directories(lab.home / "twin");
  lab.put("twin/twin.yaml",
          "format: umbsim-scenario/1\nfloor: {friction: 0.6}\ncourse: {linear_speed_mps: 0.2}\neffects:\n"
          "  tyre_creep: {along: 0.02, across: 0.03, slip_along_mps_per_n: 1e-5, slip_across_mps_per_n: 2e-5}\n");
  const std::string sdf = text_of(lab.exported("twin", "sdf") / "diff_drive.sdf");
  constexpr double kLabmate_kg = 42, kCreepAtSpeed = 2 * 0.2 / (kLabmate_kg * 9.81);
  constexpr double kDigits = 1e-5;  // of six
  const double along = 0.02 * kCreepAtSpeed + 1e-5, across = 0.03 * kCreepAtSpeed + 2e-5;
  EXPECT_NEAR(element_at(sdf, "slip1"), along, kDigits * along);
  EXPECT_NEAR(element_at(sdf, "slip2"), across, kDigits * across);
  EXPECT_NEAR(element_at(sdf, "mu"), 0.6, 1e-9);
}

TEST(Export, WhatAResultDoesNotHoldIsNamed) {
  const Lab lab;
  lab.put("empty/readme.txt", "nothing");
  for (const auto& [words, says] :
       std::vector<std::pair<Words, Words>>{{{"export", "empty", "--to", "csv"}, {"no result that can be exported"}},
                                            {{"export", "nowhere", "--to", "csv"}, {"no result that can be exported"}},
                                            {{"export", "calibrated", "--to", "mcap"}, {"no runs to export"}},
                                            {{"export", "mine", "--to", "ros2_control"}, {"holds no calibration"}},
                                            {{"export", "calibrated", "--to", "urdf"}, {"--robot"}},
                                            {{"export", "mine", "--to", "word"}, {"word not in"}}}) {
    const Outcome outcome = lab.umbsim(joined(words, {"--out", "out"}));
    EXPECT_EQ(outcome.code, 2) << outcome.out;
    expect_says(outcome.err, says);
    EXPECT_FALSE(fs::exists(lab.home / "out"));
  }
}

}  // namespace
}  // namespace umbsim::acceptance
