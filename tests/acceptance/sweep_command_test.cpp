// `umbsim sweep` as a user drives it.
#include <tinyxml2.h>

#include "tests/acceptance/sweep_program.h"

namespace umbsim::acceptance {
namespace {

class SweepCommand : public testing::Test {
 protected:
  void SetUp() override { desk_.put("tiny.yaml", kTinyScenario); }
  Outcome sweep(const std::string& text, std::vector<std::string> options = {}) {
    desk_.put("s.yaml", text);
    options.insert(options.begin(), {"sweep", "s.yaml", "--out", "s"});
    return desk_.umbsim(options);
  }
  std::string exported(std::vector<std::string> options) {
    options.insert(options.begin(), {"sweep", "export", "s"});
    const Outcome outcome = desk_.umbsim(options);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome.out;
  }
  Desk desk_;
};

TEST_F(SweepCommand, WritesItsFolder) {
  const Outcome outcome = sweep(tiny_sweep(3));
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  expect_says(outcome.out, {"s: 6 of 6 points driven, 0 failed", "open s/report.html"});
  EXPECT_EQ(listing(desk_.home / "s"),
            (std::set<std::string>{".sweep.lock", "provenance.json", "report.html", "sweep.json", "sweep.sqlite"}));
  const json result = json_of(desk_.home / "s/sweep.json");
  EXPECT_EQ(result.at("format"), "umbsim-sweep-result/1");
  EXPECT_EQ(result.at("done"), 6);
}

TEST_F(SweepCommand, WarningsOfItsPointsAreKeptAndTold) {
  const Outcome outcome = sweep("format: umbsim-sweep/1\nscenario: tiny.yaml\nset: {calibration.method: none}\n"
                                "axes:\n  effects.wheelbase.relative: [0.01, 0.45]\n");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  expect_says(unwrapped(outcome.out), {"1 points with warnings", "point 1, effects.wheelbase.relative=0.45",
                                       "heading is off by more than a radian"});
  const json warned = json_of(desk_.home / "s/sweep.json").at("warned");
  ASSERT_EQ(warned.size(), 1u);
  EXPECT_EQ(warned[0].at("point"), 1);
  EXPECT_EQ(exported({"--columns", "point,warnings"}), "point,warnings\n0,0\n1,1\n");
}

// A point of a sweep is the run of its scenario.
TEST_F(SweepCommand, APointIsARun) {
  ASSERT_EQ(sweep(tiny_sweep(3)).code, 0);
  ASSERT_EQ(desk_.umbsim({"run", "tiny.yaml", "--set", "effects.wheelbase.relative=0.02", "--set",
                          "calibration.method=endpoint", "--out", "run"}).code, 0);
  const json summary = json_of(desk_.home / "run/summary.json");
  const json rows = json::parse(exported({"--format", "json", "--columns",
                                          "umbmark.e_max_syst_m,recovery.e_b_error,recovery.after.cw.r_cg_m",
                                          "--where", "point = 4"})).at("rows");
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0][0], summary["umbmark"]["e_max_syst_m"]);
  EXPECT_EQ(rows[0][1], summary["recovery"]["e_b_error"]);
  EXPECT_EQ(rows[0][2], summary["recovery"]["after"]["cw"]["r_cg_m"]);
}

TEST_F(SweepCommand, FirstAxisChangesSlowestReplicatesFastest) {
  ASSERT_EQ(sweep("format: umbsim-sweep/1\nscenario: tiny.yaml\nreplicates: 2\naxes:\n  course.side_m: [0.4, 0.3]\n"
                  "  robot: [labmate.urdf, optiodom.urdf]\n").code, 0);
  EXPECT_EQ(exported({"--columns", "point,course.side_m,robot,replicate,point_seed"}),
            "point,course.side_m,robot,replicate,point_seed\n"
            "0,0.4,labmate.urdf,0,7\n1,0.4,labmate.urdf,1,8\n2,0.4,optiodom.urdf,0,7\n3,0.4,optiodom.urdf,1,8\n"
            "4,0.3,labmate.urdf,0,7\n5,0.3,labmate.urdf,1,8\n6,0.3,optiodom.urdf,0,7\n7,0.3,optiodom.urdf,1,8\n");
}

TEST_F(SweepCommand, DrivesListedPoints) {
  ASSERT_EQ(sweep("format: umbsim-sweep/1\nscenario: tiny.yaml\ndesign: list\npoints:\n"
                  "  - {course.side_m: 0.5, course.turn: arc, course.turn_radius_m: 0.2}\n"
                  "  - {course.turn: in_place, course.side_m: 0.3, course.turn_radius_m: 0.1}\n").code, 0);
  EXPECT_EQ(exported({"--columns", "course.side_m,course.turn"}), "course.side_m,course.turn\n0.5,arc\n0.3,in_place\n");
}

TEST_F(SweepCommand, OwnSeedsDifferFromPointToPoint) {
  ASSERT_EQ(sweep(tiny_sweep(3, "seeds: own\n")).code, 0);
  std::istringstream lines(exported({"--columns", "point_seed"}));
  std::set<std::string> seeds;
  for (std::string line; std::getline(lines, line);) seeds.insert(line);
  EXPECT_EQ(seeds.size(), 7u) << "the header and six seeds";
}

TEST_F(SweepCommand, CommandLineReplacesAxesAndValues) {
  ASSERT_EQ(sweep(tiny_sweep(3), {"--axis", "effects.wheelbase.relative={from: 0, to: 0.01, count: 2}", "--axis",
                                  "calibration.method=[none]", "--set", "course.side_m=0.4"}).code, 0);
  EXPECT_EQ(exported({"--columns", "effects.wheelbase.relative,calibration.method"}),
            "effects.wheelbase.relative,calibration.method\n0,none\n0.01,none\n");
}

TEST_F(SweepCommand, AnotherSweepDoesNotTakeItsPlace) {
  ASSERT_EQ(sweep(tiny_sweep(3)).code, 0);
  const auto before = files_of(desk_.home / "s");
  const Outcome other = sweep(tiny_sweep(4));
  EXPECT_EQ(other.code, 2);
  expect_says(other.err, {"s/sweep.sqlite", "other axes", "--force", "--out"});
  EXPECT_TRUE(files_of(desk_.home / "s") == before);
  EXPECT_EQ(sweep(tiny_sweep(4), {"--force"}).code, 0);
  EXPECT_EQ(points_in(desk_.home / "s/sweep.sqlite"), 8);
}

TEST_F(SweepCommand, DoesNotTouchAForeignFolder) {
  desk_.put("s/thesis.tex", "\\begin{document}");
  const Outcome outcome = sweep(tiny_sweep(2), {"--force"});
  EXPECT_EQ(outcome.code, 2);
  expect_says(outcome.err, {"s: exists and is not a sweep"});
  EXPECT_EQ(listing(desk_.home / "s"), std::set<std::string>{"thesis.tex"});
}

TEST_F(SweepCommand, OnAFullDiskItFailsAndGoesOnAfterwards) {
  desk_.put("s.yaml", tiny_sweep(60));
  const std::string command = shell_quoted(UMBSIM_PROGRAM) + " sweep s.yaml --out s";
  const Outcome full = desk_.shell("trap '' XFSZ; ulimit -f 128; " + command);
  EXPECT_EQ(full.code, 3) << full.out;
  expect_says(full.err, {"s/sweep.sqlite", "disk"});
  ASSERT_EQ(desk_.shell(command).code, 0);
  ASSERT_EQ(desk_.shell(command + "2").code, 0);
  EXPECT_TRUE(content_of(desk_.home / "s/sweep.sqlite") == content_of(desk_.home / "s2/sweep.sqlite"));
}

// ---- expectations

const std::string kExpect =
    "expect:\n  recovery.e_b_error: {abs_max: 1}\n"
    "  umbmark.e_max_syst_m: [{max: 0.005, where: calibration.method = heading}, {max: 0.5, quantile: 0.9}]\n";

TEST_F(SweepCommand, UnmetExpectationsAreListed) {
  const Outcome outcome = sweep(tiny_sweep(3, kExpect), {"--junit", "junit.xml"});
  EXPECT_EQ(outcome.code, 1);
  expect_says(unwrapped(outcome.out),
              {"met      recovery.e_b_error: abs_max 1  (6 points, worst",
               "NOT MET  umbmark.e_max_syst_m: max 0.005, where calibration.method = heading (2 of 3 points)",
               "point 1, effects.wheelbase.relative=-0.02, calibration.method=heading: ",
               "point 5, effects.wheelbase.relative=0.02, calibration.method=heading: ",
               "met      umbmark.e_max_syst_m: max 0.5, quantile 0.9"});
  EXPECT_EQ(outcome.err, "umbsim: an expectation was not met\n");
  EXPECT_TRUE(fs::exists(desk_.home / "s/report.html")) << "the result is there all the same";
}

TEST_F(SweepCommand, JunitHoldsATestCaseForEveryPoint) {
  sweep(tiny_sweep(3, kExpect), {"--junit", "junit.xml"});
  tinyxml2::XMLDocument document;
  ASSERT_EQ(document.LoadFile((desk_.home / "junit.xml").c_str()), tinyxml2::XML_SUCCESS);
  const auto* suite = document.FirstChildElement("testsuites")->FirstChildElement("testsuite");
  EXPECT_STREQ(suite->Attribute("name"), "s");
  int cases = 0, failures = 0;
  for (const auto* c = suite->FirstChildElement("testcase"); c; c = c->NextSiblingElement("testcase")) {
    ++cases;
    if (const auto* failure = c->FirstChildElement("failure")) {
      ++failures;
      EXPECT_NE(std::string(failure->Attribute("message")).find("expected umbmark.e_max_syst_m: max 0.005"),
                std::string::npos);
    }
  }
  EXPECT_EQ(suite->IntAttribute("tests"), cases);
  EXPECT_EQ(cases, 1 + 6 + 3 + 1);
  EXPECT_EQ(suite->IntAttribute("failures"), failures);
  EXPECT_EQ(failures, 2);
}

// Expectations are no part of what was driven: they may change.
TEST_F(SweepCommand, ExpectationsMayChangeOnAFinishedSweep) {
  ASSERT_EQ(sweep(tiny_sweep(3, kExpect)).code, 1);
  const std::string before = content_of(desk_.home / "s/sweep.sqlite");
  EXPECT_EQ(sweep(tiny_sweep(3, "expect: {umbmark.e_max_syst_m: {max: 0.5}}\n")).code, 0);
  EXPECT_TRUE(content_of(desk_.home / "s/sweep.sqlite") == before);
}

TEST_F(SweepCommand, APointWithoutTheFigureDoesNotMeetIt) {
  const Outcome outcome = sweep(tiny_sweep(2, "expect: {recovery.e_b_error: {abs_max: 1}}\n"),
                                {"--axis", "calibration.method=[none, heading]"});
  EXPECT_EQ(outcome.code, 1);
  expect_says(unwrapped(outcome.out), {"(2 of 4 points)", "calibration.method=none: no value"});
}

// A driver that steers by readings of 0.8 s ago cannot hold its course.
const char* const kFailing =
    "format: umbsim-sweep/1\nscenario: tiny.yaml\nset: {course.side_m: 4}\n"
    "axes: {effects.encoder_sampling.interval_s: [0, 0.8]}\n";

TEST_F(SweepCommand, PointsThatCannotBeDrivenAreResults) {
  const Outcome outcome = sweep(kFailing, {"--junit", "junit.xml"});
  EXPECT_EQ(outcome.code, 3);
  expect_says(unwrapped(outcome.out),
              {"1 of 2 points driven, 1 failed", "point 1, effects.encoder_sampling.interval_s=0.8: ", "control loop"});
  expect_says(text_of(desk_.home / "junit.xml"), {"errors=\"1\"", "<error message=", "control loop"});
  EXPECT_EQ(json_of(desk_.home / "s/sweep.json").at("failed").size(), 1u);
}

TEST_F(SweepCommand, ASweepMayExpectFailures) {
  EXPECT_EQ(sweep(std::string(kFailing) + "expect: {failed_points: {min: 1, max: 1}}\n").code, 0);
  EXPECT_EQ(sweep(std::string(kFailing) + "expect: {failed_points: {max: 0}}\n").code, 1);
}

TEST_F(SweepCommand, FailedPointsAreDrivenAgainOnRequest) {
  ASSERT_EQ(sweep(kFailing).code, 3);
  Database(desk_.home / "s/sweep.sqlite", Database::Mode::write)
      .run("UPDATE points SET error = 'old' WHERE status = 'failed'");
  expect_says(unwrapped(sweep(kFailing).out), {": old"});
  expect_says(unwrapped(sweep(kFailing, {"--retry-failed"}).out), {"control loop"});
}

TEST_F(SweepCommand, ARunHasExpectationsToo) {
  desk_.put("expecting.yaml", std::string(kTinyScenario) +
                                  "expect:\n  recovery.e_b_error: {abs_max: 1}\n  umbmark.e_max_syst_m: {min: 0.1}\n");
  const Outcome outcome = desk_.umbsim({"run", "expecting.yaml", "--out", "r", "--junit", "r.xml"});
  EXPECT_EQ(outcome.code, 1);
  expect_says(outcome.out, {"met      recovery.e_b_error: abs_max 1", "NOT MET  umbmark.e_max_syst_m: min 0.1"});
  expect_says(text_of(desk_.home / "r.xml"), {"testsuite name=\"expecting\"", "failures=\"1\""});
  // The resolved scenario asks for the same.
  EXPECT_EQ(desk_.umbsim({"run", "r/scenario.resolved.yaml", "--out", "again"}).code, 1);
  EXPECT_EQ(desk_
                .umbsim({"run", "r/scenario.resolved.yaml", "--out", "met", "--set", "expect.umbmark={}", "--set",
                         "expect={}"})
                .code,
            0);
}

}  // namespace
}  // namespace umbsim::acceptance
