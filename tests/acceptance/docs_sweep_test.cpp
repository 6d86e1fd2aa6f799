// docs/sweep.md and docs/ci.md: their examples are accepted and work.
#include <yaml-cpp/yaml.h>

#include "experiment/output/figures.h"
#include "experiment/sweep/sweep.h"
#include "tests/acceptance/markdown.h"
#include "tests/acceptance/program.h"

namespace umbsim::acceptance {
namespace {

std::string document(const char* name) { return std::string(UMBSIM_SOURCE_DIR) + "/docs/" + name; }

TEST(SweepDocument, ItsExampleMeetsItsExpectations) {
  const Desk desk;
  fs::create_directory(desk.home / "sweeps");
  fs::copy_file(shipped("nominal"), desk.home / "nominal.yaml");
  const std::vector<std::string> blocks = fenced_blocks(document("sweep.md"), "yaml");
  ASSERT_EQ(blocks.size(), 1u);
  desk.put("sweeps/example.yaml", blocks[0]);
  const Outcome outcome = desk.umbsim({"sweep", "sweeps/example.yaml"});
  EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
}

// Every way to write the values of an axis that the table shows.
TEST(SweepDocument, EveryFormOfAnAxisIsAccepted) {
  const std::string text = text_of(document("sweep.md"));
  const Desk desk;
  desk.put("base.yaml", "format: umbsim-scenario/1\n");
  int found = 0;
  for (std::size_t at = text.find("| `{from"); at != std::string::npos; at = text.find("| `{from", at + 1)) {
    const std::string values = text.substr(at + 3, text.find('`', at + 3) - at - 3);
    const bool sampled = values.find("count") == std::string::npos && values.find("step") == std::string::npos;
    const fs::path file = desk.put("s.yaml", "format: umbsim-sweep/1\nscenario: base.yaml\n" +
                                                 std::string(sampled ? "design: sobol\nsamples: 2\n" : "") +
                                                 "axes: {course.turn_radius_m: " + values + "}\n");
    EXPECT_GT(read_sweep(file.string()).points, 1) << values;
    ++found;
  }
  EXPECT_EQ(found, 5);
}

TEST(SweepDocument, NamesEveryShippedSweepWithItsPoints) {
  const std::string text = text_of(document("sweep.md"));
  for (const auto& entry : fs::directory_iterator(fs::path(UMBSIM_SOURCE_DIR) / "scenarios/sweeps")) {
    const std::string line = "| `" + entry.path().filename().string() + "` | " +
                             std::to_string(read_sweep(entry.path().string()).points) + " |";
    EXPECT_NE(text.find(line), std::string::npos) << line;
  }
}

// The steps of the GitHub Actions job that start the program.
TEST(CiDocument, ItsJobWorks) {
  const std::vector<std::string> blocks = fenced_blocks(document("ci.md"), "yaml");
  ASSERT_EQ(blocks.size(), 1u);
  const Desk desk;
  fs::create_symlink(fs::path(UMBSIM_SOURCE_DIR) / "scenarios", desk.home / "scenarios");
  fs::create_symlink(UMBSIM_PROGRAM, desk.home / "umbsim");
  std::string published;
  int driven = 0;
  for (const auto& step : YAML::Load(blocks[0])["jobs"]["sweep"]["steps"]) {
    if (step["run"] && step["run"].as<std::string>().rfind("./umbsim", 0) == 0) {
      const Outcome outcome = desk.shell(step["run"].as<std::string>());
      EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
      ++driven;
    }
    if (step["with"] && step["with"]["report_paths"]) published = step["with"]["report_paths"].as<std::string>();
    if (step["with"] && step["with"]["name"]) {
      EXPECT_TRUE(fs::exists(desk.home / step["with"]["path"].as<std::string>() / "report.html"));
    }
  }
  EXPECT_EQ(driven, 1);
  expect_says(text_of(desk.home / published), {"<testsuite name=\"recovery\"", "failures=\"0\""});
}

TEST(SweepDatabaseDocument, NamesEveryTable) {
  const std::string text = text_of(document("sweep-database.md"));
  for (const char* table : {"sweep", "points", "figures", "runs", "provenance", "starts", "results"}) {
    EXPECT_NE(text.find("| `" + std::string(table) + "` |"), std::string::npos) << table;
  }
  for (const std::string figure : {"umbmark.e_max_syst_m", "recovery.e_d_error"}) {
    EXPECT_NE(std::find(figure_names().begin(), figure_names().end(), figure), figure_names().end());
  }
}

}  // namespace
}  // namespace umbsim::acceptance
