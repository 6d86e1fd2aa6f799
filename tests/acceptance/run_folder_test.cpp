#include <algorithm>
#include <cmath>

#include "core/text/wrapped_text.h"
#include "tests/acceptance/program.h"

namespace umbsim::acceptance {
namespace {

/// A shipped scenario and what its run folder must hold.
struct Shipped {
  const char* name;
  int per_direction;
  bool bumped;
  bool calibrated;
};

constexpr Shipped kShipped[] = {
    {"umbmark", 5, false, true},         {"labmate_exact", 1, false, true},       {"nominal", 1, false, false},
    {"extended_umbmark", 5, true, true}, {"unidirectional_trap", 1, false, true}, {"uncertainty", 10, false, false}};

/// Courses that are no squares: UMBmark says nothing of them.
constexpr const char* kOtherCourses[] = {"circle", "figure_eight", "waypoints"};

void add_recording(std::set<std::string>& names, const std::string& below, int per_direction, bool bumped) {
  names.insert({below + "recording.yaml", below + "labmate.urdf"});
  for (const std::string kind : {"", "-bumped"}) {
    if (!kind.empty() && !bumped) continue;
    for (const std::string direction : {"cw", "ccw"}) {
      for (int i = 1; i <= per_direction; ++i) {
        const std::string run = below + "runs/" + direction + kind + "-" + std::to_string(i);
        names.insert({run + "/encoders.csv", run + "/truth.csv"});
      }
    }
  }
}

std::set<std::string> documented_files(const Shipped& s) {
  std::set<std::string> names{"scenario.resolved.yaml", "provenance.json", "summary.json", "report.html"};
  add_recording(names, "", s.per_direction, s.bumped);
  if (!s.calibrated) return names;
  names.insert("calibration.yaml");
  add_recording(names, "calibrated/", s.per_direction, false);
  return names;
}

void expect_numbers(const json& object, const std::vector<std::string>& paths) {
  for (const std::string& path : paths) {
    const json::json_pointer pointer(path);
    ASSERT_TRUE(object.contains(pointer)) << path;
    ASSERT_TRUE(object.at(pointer).is_number()) << path << " is " << object.at(pointer);
    EXPECT_TRUE(std::isfinite(object.at(pointer).get<double>())) << path;
  }
}

class ShippedScenario : public testing::TestWithParam<Shipped> {};

TEST_P(ShippedScenario, WritesTheDocumentedFolder) {
  const Shipped& s = GetParam();
  const Desk desk;
  const Outcome run = desk.umbsim({"run", shipped(s.name)});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.err, "") << "quiet in a pipe";
  expect_says(run.out, {"E_max,syst", "results/" + std::string(s.name) + "/report.html"});
  EXPECT_EQ(listing(desk.home), std::set<std::string>{"results"});
  EXPECT_EQ(listing(desk.home / "results"), (std::set<std::string>{"index.html", "latest", s.name}));

  const fs::path folder = desk.home / "results" / s.name;
  EXPECT_EQ(names_of(files_of(folder)), documented_files(s));

  const json summary = json_of(folder / "summary.json");
  EXPECT_EQ(summary.at("format"), "umbsim-result/1");
  std::vector<std::string> paths{"/umbmark/e_max_syst_m", "/injected/e_d", "/injected/e_b",         "/cost/simulated_s",
                                 "/cost/wall_s",          "/cost/steps",   "/cost/solver_fallbacks"};
  for (const std::string direction : {"cw", "ccw"}) {
    for (const std::string key : {"centroid_x_m", "centroid_y_m", "heading_rad", "runs"}) {
      paths.push_back("/umbmark/" + direction + "/" + key);
    }
    EXPECT_EQ(summary.at("umbmark").at(direction).at("runs"), s.per_direction);
  }
  for (const std::string form : {"endpoint", "heading"}) {
    paths.insert(paths.end(), {"/calibration/" + form + "/e_d", "/calibration/" + form + "/e_b"});
  }
  if (s.bumped) {
    paths.insert(paths.end(), {"/extended/mean_abs_heading_error_rad", "/extended/per_bump_heading_error_rad"});
  }
  if (s.calibrated) {
    paths.insert(paths.end(),
                 {"/recovery/e_d_error", "/recovery/e_b_error", "/recovery/e_max_after_m", "/recovery/improvement"});
  }
  expect_numbers(summary, paths);
  EXPECT_EQ(summary.contains("extended"), s.bumped);
  EXPECT_EQ(summary.contains("recovery"), s.calibrated);

  const json provenance = json_of(folder / "provenance.json");
  for (const char* key : {"version", "commit", "seed", "compiler", "bullet_version", "host"}) {
    EXPECT_TRUE(provenance.contains(key)) << key;
  }
}

INSTANTIATE_TEST_SUITE_P(Every, ShippedScenario, testing::ValuesIn(kShipped),
                         [](const auto& param_info) { return std::string(param_info.param.name); });

class OtherCourse : public testing::TestWithParam<const char*> {};

TEST_P(OtherCourse, IsARecordingWithoutUmbmark) {
  const Desk desk;
  const Outcome run = desk.umbsim({"run", GetParam(), "--out", "r"});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.out.find("E_max"), std::string::npos) << run.out;
  EXPECT_FALSE(json_of(desk.home / "r/summary.json").contains("umbmark"));
  EXPECT_TRUE(fs::exists(desk.home / "r/runs/ccw-3/truth.csv"));
  EXPECT_EQ(desk.umbsim({"calibrate", "r", "--method", "least-squares", "--out", "c"}).code, 0);
}

INSTANTIATE_TEST_SUITE_P(Every, OtherCourse, testing::ValuesIn(kOtherCourses),
                         [](const auto& param_info) { return std::string(param_info.param); });

TEST(ShippedScenarios, AreAllTested) {
  std::set<std::string> tested, present;
  for (const Shipped& s : kShipped) tested.insert(s.name);
  for (const char* name : kOtherCourses) tested.insert(name);
  for (const auto& entry : fs::directory_iterator(fs::path(UMBSIM_SOURCE_DIR) / "scenarios")) {
    if (entry.is_directory()) continue;  // effects/: tests/effects drives them all
    EXPECT_EQ(entry.path().extension(), ".yaml") << "scenarios/ holds YAML only";
    present.insert(entry.path().stem().string());
  }
  EXPECT_EQ(tested, present);
}

TEST(RunFolder, WithoutAFileTheDefaultScenarioRuns) {
  const Desk desk;
  const Outcome run = desk.umbsim({"run", "--set", "runs.per_direction=1", "--set", "course.side_m=0.5"});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_TRUE(fs::exists(desk.home / "results/umbmark/summary.json"));
}

// scenario.resolved.yaml is the experiment with every default written out: it gives the same folder again.
TEST(RunFolder, ResolvedScenarioGivesTheSameRunsAgain) {
  const Desk desk;
  desk.put("short.yaml", std::string(kShortScenario) + "bumps: {count: 2, leg: 2, height_m: 0.004}\n");
  ASSERT_EQ(desk.umbsim({"run", "short.yaml", "--out", "a"}).code, 0);
  const Outcome again = desk.umbsim({"run", "a/scenario.resolved.yaml", "--out", "b"});
  ASSERT_EQ(again.code, 0) << again.err;
  auto a = files_of(desk.home / "a"), b = files_of(desk.home / "b");
  for (auto* files : {&a, &b}) {
    files->erase("provenance.json");  // names its input file
    json summary = json::parse(files->at("summary.json"));
    summary.at("cost").erase("wall_s");
    files->at("summary.json") = summary.dump();
  }
  EXPECT_EQ(names_of(a), names_of(b));
  for (const auto& [name, text] : a) EXPECT_EQ(text == b[name], true) << name << " differs";
}

// Both forms are shown, that whose corrections were applied first.
TEST(RunFolder, SaysWhichFormWasApplied) {
  const Desk desk;
  desk.put("short.yaml", kShortScenario);
  for (const std::string method : {"endpoint", "heading", "none"}) {
    const Outcome run = desk.umbsim({"run", "short.yaml", "--set", "calibration.method=" + method, "--out", method});
    ASSERT_EQ(run.code, 0) << run.err;
    const json calibration = json_of(desk.home / method / "summary.json").at("calibration");
    EXPECT_EQ(calibration.at("applied"), method);
    const std::size_t endpoint = run.out.find("\n  endpoint "), heading = run.out.find("\n  heading ");
    ASSERT_NE(std::max(endpoint, heading), std::string::npos) << run.out;
    EXPECT_EQ(heading < endpoint, method == "heading") << run.out;
    const std::size_t applied = run.out.find("  applied\n");
    EXPECT_EQ(applied == std::string::npos, method == "none") << run.out;
    if (method != "none") {
      EXPECT_EQ(run.out.rfind('\n', applied), std::min(endpoint, heading)) << run.out;
    }
    for (const char* form : {"endpoint", "heading"}) {
      const std::string trust = calibration.at(form).at("trust");
      expect_says(run.out, {"\n" + wrapped(std::string("  ") + form + ": " + trust, 4)});
    }
  }
}

TEST(RunFolder, OneDirectionAloneWarns) {
  const Desk desk;
  desk.put("short.yaml", kShortScenario);
  const Outcome run = desk.umbsim({"run", "short.yaml", "--set", "runs.directions=[cw]", "--out", "a"});
  ASSERT_EQ(run.code, 0) << run.err;
  expect_says(run.out, {"a one-way test is unfit for"});  // the line is broken after it
  const json summary = json_of(desk.home / "a/summary.json");
  EXPECT_FALSE(summary.contains("umbmark"));
  expect_says(summary.at("one_way").at("warning").get<std::string>(), {"unfit for differential drives"});
}

TEST(RunFolder, TrapShowsNothingOneWayAndMuchTheOther) {
  const Desk desk;
  const Outcome run = desk.umbsim({"run", shipped("unidirectional_trap"), "--out", "a"});
  ASSERT_EQ(run.code, 0) << run.err;
  expect_says(run.out, {"the cw square alone would have reported"});
  const json u = json_of(desk.home / "a/summary.json").at("umbmark");
  constexpr double kLooksPerfect_m = 0.005;  // a tape measure would not see it
  constexpr double kIsNot_m = 1;
  EXPECT_LT(u.at("cw").at("r_cg_m"), kLooksPerfect_m);
  EXPECT_GT(u.at("ccw").at("r_cg_m"), kIsNot_m);
}

// Runs with cables at given places must not count as plain squares.
TEST(RunFolder, FixedCablesMakeBumpedRuns) {
  const Desk desk;
  const Outcome run =
      desk.umbsim({"run", shipped("nominal"), "--set", "bumps.cables=[{x_m: 2, y_m: -0.17}]", "--out", "a"});
  ASSERT_EQ(run.code, 0) << run.err;
  const json summary = json_of(desk.home / "a/summary.json");
  EXPECT_EQ(summary.at("umbmark").at("cw").at("runs"), 1);
  ASSERT_TRUE(summary.contains("extended"));
  // One 10 mm cable under the right wheel of a robot with R = 75 mm, b = 340 mm: 0.573 degrees towards it, whether it
  // drives cw or ccw. cos psi = (R - r) / (R + r); path excess 2 (R + r) psi - 4 sqrt(R r).
  const double R = 0.075, r = 0.005, b = 0.340;
  const double psi = std::acos((R - r) / (R + r));
  const double turn_rad = (2 * (R + r) * psi - 4 * std::sqrt(R * r)) / b;
  constexpr double kModel = 0.04;  // relative: speed of the crossing, softness of the contact
  for (const char* direction : {"cw", "ccw"}) {
    EXPECT_NEAR(summary.at("extended").at(direction).at("heading_rad").get<double>(), -turn_rad, kModel * turn_rad);
  }
}

}  // namespace
}  // namespace umbsim::acceptance
