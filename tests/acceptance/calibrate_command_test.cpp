#include <cmath>

#include "tests/acceptance/program.h"

namespace umbsim::acceptance {
namespace {

// Truth is written to 1e-9 m and rad; what calibrate reads differs from what run measured by this much.
constexpr double kWritten = 1e-8;

void expect_same_numbers(const json& a, const json& b, const std::string& where) {
  if (a.is_object()) {
    for (const auto& [key, value] : a.items()) {
      ASSERT_TRUE(b.contains(key)) << where << "/" << key;
      expect_same_numbers(value, b.at(key), where + "/" + key);
    }
  } else if (a.is_number()) {
    EXPECT_NEAR(a.get<double>(), b.get<double>(), kWritten) << where;
  }
}

// Every run folder is a recording: what the experiment measured can be computed from it again.
TEST(CalibrateCommand, AgreesWithTheRunFolderItReads) {
  const Desk desk;
  ASSERT_EQ(desk.umbsim({"run", shipped("umbmark"), "--out", "a"}).code, 0);
  const Outcome calibrate = desk.umbsim({"calibrate", "a", "--out", "c"});
  ASSERT_EQ(calibrate.code, 0) << calibrate.err;
  EXPECT_EQ(calibrate.err, "") << "quiet in a pipe";
  const json summary = json_of(desk.home / "a/summary.json"), json = json_of(desk.home / "c/calibration.json");
  EXPECT_EQ(json.at("format"), "umbsim-calibration/1");
  for (const char* part : {"umbmark", "calibration"}) expect_same_numbers(summary.at(part), json.at(part), part);

  // The proof runs are a recording as well: driven with corrected odometry, read with the nominal one they show the
  // same errors as before, to the accuracy of the noise.
  EXPECT_EQ(desk.umbsim({"calibrate", "a/calibrated", "--out", "d"}).code, 0);
}

TEST(CalibrateCommand, SaysWhichFormItApplied) {
  const Desk desk;
  desk.put("short.yaml", kShortScenario);
  ASSERT_EQ(desk.umbsim({"run", "short.yaml", "--out", "a"}).code, 0);
  for (const std::string method : {"endpoint", "heading"}) {
    const Outcome calibrate = desk.umbsim({"calibrate", "a", "--method", method, "--out", method});
    ASSERT_EQ(calibrate.code, 0) << calibrate.err;
    const json c = json_of(desk.home / method / "calibration.json");
    EXPECT_EQ(c.at("calibration").at("applied"), method);
    const std::size_t line = calibrate.out.rfind('\n', calibrate.out.find("  applied\n"));
    EXPECT_EQ(calibrate.out.compare(line, method.size() + 3, "\n  " + method), 0) << calibrate.out;
  }
}

TEST(CalibrateCommand, TheDefaultFolderIsNamedAfterTheRecording) {
  const Desk desk;
  desk.put("short.yaml", kShortScenario);
  ASSERT_EQ(desk.umbsim({"run", "short.yaml"}).code, 0);
  const Outcome calibrate = desk.umbsim({"calibrate", "results/short/"});
  ASSERT_EQ(calibrate.code, 0) << calibrate.err;
  EXPECT_EQ(listing(desk.home / "results"),
            (std::set<std::string>{"index.html", "latest", "short", "short-calibration"}));
}

// calibration.yaml goes into a scenario as it is, and the squares then close.
TEST(CalibrateCommand, ItsYamlCuresTheScenario) {
  const Desk desk;
  ASSERT_EQ(desk.umbsim({"run", shipped("labmate_exact"), "--out", "a"}).code, 0);
  ASSERT_EQ(desk.umbsim({"calibrate", "a", "--out", "c"}).code, 0);
  desk.put("cured.yaml", text_of(shipped("labmate_exact")) + text_of(desk.home / "c/calibration.yaml"));
  const Outcome cured = desk.umbsim({"run", "cured.yaml", "--out", "b"});
  ASSERT_EQ(cured.code, 0) << cured.err;
  constexpr double kClosed_m = 0.0005;
  EXPECT_LT(json_of(desk.home / "b/summary.json").at("umbmark").at("e_max_syst_m"), kClosed_m);
}

/// Published figures of a real robot (UMBmark on its raw ticks), to the last digit given: mm, degrees.
struct RealRobot {
  const char* folder;
  double cw_x, cw_y, cw_heading, ccw_x, ccw_y, ccw_heading, e_max, e_d, e_b;
};

class RealRecording : public testing::TestWithParam<RealRobot> {};

TEST_P(RealRecording, GivesThePublishedFigures) {
  const RealRobot& r = GetParam();
  const fs::path recording = fs::path(UMBSIM_SHARED_DIR) / "recordings" / r.folder;
  if (!fs::exists(recording)) GTEST_SKIP() << recording << " is not here";
  const Desk desk;
  const Outcome outcome = desk.umbsim({"calibrate", recording.string(), "--out", "c"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json c = json_of(desk.home / "c/calibration.json");
  const auto number = [&](const char* path) { return c.at(json::json_pointer(path)).get<double>(); };
  constexpr double kHalfDigit_mm = 0.0501, kHalfDigit_deg = 0.00501, kHalfDigit = 0.00000501;
  const double degrees = 180 / M_PI;
  EXPECT_NEAR(number("/umbmark/cw/centroid_x_m") * 1000, r.cw_x, kHalfDigit_mm);
  EXPECT_NEAR(number("/umbmark/cw/centroid_y_m") * 1000, r.cw_y, kHalfDigit_mm);
  EXPECT_NEAR(number("/umbmark/cw/heading_rad") * degrees, r.cw_heading, kHalfDigit_deg);
  EXPECT_NEAR(number("/umbmark/ccw/centroid_x_m") * 1000, r.ccw_x, kHalfDigit_mm);
  EXPECT_NEAR(number("/umbmark/ccw/centroid_y_m") * 1000, r.ccw_y, kHalfDigit_mm);
  EXPECT_NEAR(number("/umbmark/ccw/heading_rad") * degrees, r.ccw_heading, kHalfDigit_deg);
  EXPECT_NEAR(number("/umbmark/e_max_syst_m") * 1000, r.e_max, kHalfDigit_mm);
  EXPECT_NEAR(number("/calibration/endpoint/e_d"), r.e_d, kHalfDigit);
  EXPECT_NEAR(number("/calibration/endpoint/e_b"), r.e_b, kHalfDigit);
}

INSTANTIATE_TEST_SUITE_P(
    Optiodom, RealRecording,
    testing::Values(RealRobot{"optiodom-square-0.75m", -10.9, -6.2, 1.71, -23.2, 19.7, -2.97, 30.5, 0.99890, 1.00729},
                    RealRobot{"optiodom-square-1.7m", -15.3, -16.9, 3.05, -67.1, 79.9, -5.81, 104.4, 0.99910, 1.00778}),
    [](const auto& param_info) { return "Square" + std::to_string(param_info.index + 1); });

TEST(CalibrateCommand, SeveralRecordingsAndEveryMethodInOneTable) {
  const Desk desk;
  desk.put("short.yaml", kShortScenario);
  ASSERT_EQ(desk.umbsim({"run", "short.yaml", "--out", "a"}).code, 0);
  ASSERT_EQ(desk.umbsim({"run", "short.yaml", "--set", "seed=2", "--out", "b"}).code, 0);
  const Outcome outcome = desk.umbsim({"calibrate", "a", "b", "--out", "c"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  expect_says(outcome.out, {"endpoint", "iterated", "heading", "least-squares", "kelly", "likelihood", "no answer",
                            "cannot be seen", "Winner: ", "[2] b"});
  const json c = json_of(desk.home / "c/calibration.json").at("comparison");
  EXPECT_EQ(c.at("methods").size(), 9u) << "nominal and eight";
  EXPECT_EQ(c.at("folds"), 2);
}

// Everything that a page of the calibration draws.
TEST(CalibrateCommand, HoldsReturnErrorsAndResidualsBeforeAndAfter) {
  const Desk desk;
  desk.put("short.yaml", kShortScenario);
  ASSERT_EQ(desk.umbsim({"run", "short.yaml", "--out", "a"}).code, 0);
  ASSERT_EQ(desk.umbsim({"calibrate", "a", "--out", "c"}).code, 0);
  const json c = json_of(desk.home / "c/calibration.json");
  ASSERT_EQ(c.at("squares").size(), 1u);
  const json& squares = c.at("squares")[0];
  for (const char* when : {"before", "after"}) {
    for (const char* direction : {"cw", "ccw"}) {
      const json& errors = squares.at(when).at(direction).at("errors");
      EXPECT_EQ(errors.size(), squares.at(when).at(direction).at("runs").get<std::size_t>());
    }
  }
  EXPECT_EQ(squares.at("before").at("e_max_syst_m"), c.at("umbmark").at("e_max_syst_m"));
  ASSERT_FALSE(c.at("runs").empty());
  for (const json& run : c.at("runs")) {
    const std::size_t n = run.at("time_s").size();
    EXPECT_LE(n, 100u);
    for (const char* part : {"tracked", "before", "after"}) {
      for (const char* column : {"x_m", "y_m", "theta_rad"}) EXPECT_EQ(run.at(part).at(column).size(), n);
    }
    EXPECT_TRUE(run.at("final_mm").contains("nominal"));
  }
}

// Each new course from the scenario to a calibration by what it is made for.
TEST(CalibrateCommand, CalibratesOnEveryShapeOfCourse) {
  const Desk desk;
  for (const auto& [scenario, method] :
       {std::pair{"circle", "circles"}, std::pair{"figure_eight", "circles"}, std::pair{"waypoints", "kelly"}}) {
    ASSERT_EQ(desk.umbsim({"run", scenario, "--out", scenario}).code, 0);
    const std::string out = std::string(scenario) + "-c";
    const Outcome outcome = desk.umbsim({"calibrate", scenario, "--method", method, "--out", out});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const json o = json_of(desk.home / out / "calibration.json").at("odometry");
    EXPECT_NEAR(o.at("wheelbase_m").get<double>(), 0.340 * (1 - 0.0113), 0.001) << scenario;
    EXPECT_NEAR(o.at("right_radius_m").get<double>() / o.at("left_radius_m").get<double>(), 1.00084, 5e-4) << scenario;
  }
}

// What limits the answer without making it wrong is said, not refused.
TEST(CalibrateCommand, SaysWhatLimitsItsAnswer) {
  const Desk desk;
  desk.put("short.yaml", kShortScenario);
  ASSERT_EQ(desk.umbsim({"run", "short.yaml", "--set", "runs.per_direction=1", "--out", "a"}).code, 0);
  const Outcome outcome = desk.umbsim({"calibrate", "a", "--out", "c"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  expect_says(outcome.out, {"Limit: no run was repeated"});
  const json limits = json_of(desk.home / "c/calibration.json").at("limits");
  ASSERT_EQ(limits.size(), 1u);
  expect_says(limits[0].get<std::string>(), {"no run was repeated"});
}

// Recordings of another engine (with bumps, fewer runs, other shapes) are read or refused, never a crash. The quickest
// method: what is tried is what goes before all of them.
TEST(CalibrateCommand, ReadsOrRefusesEverySharedRecording) {
  const fs::path root = fs::path(UMBSIM_SHARED_DIR) / "recordings";
  if (!fs::is_directory(root)) GTEST_SKIP() << root << " is not here";
  const Desk desk;
  int calibrated = 0;
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    if (entry.path().filename() != "recording.yaml") continue;
    const Outcome outcome = desk.umbsim(
        {"calibrate", entry.path().parent_path().string(), "--method", "least-squares", "--out", "c", "--force"});
    EXPECT_TRUE(outcome.code == 0 || outcome.code == 2) << entry.path() << ": " << outcome.code << " " << outcome.err;
    calibrated += outcome.code == 0;
  }
  EXPECT_GT(calibrated, 2);
}

}  // namespace
}  // namespace umbsim::acceptance
