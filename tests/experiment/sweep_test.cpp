#include "experiment/sweep/sweep.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "experiment/output/figures.h"
#include "experiment/output/result_json.h"

namespace umbsim {
namespace {

namespace fs = std::filesystem;

class SweepFile : public ::testing::Test {
 protected:
  SweepFile() : folder_(::testing::TempDir() + "umbsim_sweep_" + std::to_string(getpid())) {
    fs::create_directories(folder_);
    std::ofstream(folder_ + "/base.yaml") << "format: umbsim-scenario/1\nseed: 5\n";
  }
  ~SweepFile() override { fs::remove_all(folder_); }
  Sweep read(const std::string& rest) const {
    std::ofstream(folder_ + "/s.yaml") << "format: umbsim-sweep/1\nscenario: base.yaml\n" + rest;
    return read_sweep(folder_ + "/s.yaml");
  }
  std::vector<std::string> values_of(const std::string& axis) const {
    std::vector<std::string> texts;
    for (const AxisValue& v : read("axes: {course.side_m: " + axis + "}\n").axes[0].values) texts.push_back(v.yaml);
    return texts;
  }
  std::string folder_;
};

using Texts = std::vector<std::string>;

TEST_F(SweepFile, RangesHaveTidyValuesAndBothEnds) {
  EXPECT_EQ(values_of("{from: 0.1, to: 0.5, count: 5}"), (Texts{"0.1", "0.2", "0.3", "0.4", "0.5"}));
  EXPECT_EQ(values_of("{from: 0.1, to: 0.4, step: 0.1}"), (Texts{"0.1", "0.2", "0.3", "0.4"}));
  EXPECT_EQ(values_of("{from: 0.1, to: 0.39, step: 0.1}"), (Texts{"0.1", "0.2", "0.3"}));
  EXPECT_EQ(values_of("{from: 0.01, to: 100, count: 5, scale: log}"), (Texts{"0.01", "0.1", "1", "10", "100"}));
  EXPECT_EQ(values_of("{from: 1, to: 10, count: 4, integer: true}"), (Texts{"1", "4", "7", "10"}));
  EXPECT_EQ(values_of("[3, 1.5, 2e-1]"), (Texts{"3", "1.5", "2e-1"}));
}

TEST_F(SweepFile, PointsOfAGridCombineAllValues) {
  const Sweep sweep = read("axes: {course.side_m: [1, 2, 3], course.laps: [1, 2]}\nreplicates: 4\n");
  ASSERT_EQ(sweep.points, 24);
  std::set<std::string> labels;
  for (std::int64_t i = 0; i < sweep.points; ++i) labels.insert(label(sweep, sweep_point(sweep, i)));
  EXPECT_EQ(labels.size(), 24u);
  EXPECT_EQ(label(sweep, sweep_point(sweep, 0)), "course.side_m=1, course.laps=1, replicate 0");
  EXPECT_EQ(label(sweep, sweep_point(sweep, 23)), "course.side_m=3, course.laps=2, replicate 3");
}

TEST_F(SweepFile, SampledRangesAreCrossedWithLists) {
  const Sweep sweep = read(
      "design: sobol\nsamples: 3\naxes:\n  course.side_m: {from: 1, to: 9}\n"
      "  calibration.method: [endpoint, heading]\n  course.laps: {from: 1, to: 4, integer: true}\n");
  ASSERT_EQ(sweep.points, 6);
  EXPECT_EQ(label(sweep, sweep_point(sweep, 0)), "course.side_m=5, calibration.method=endpoint, course.laps=3");
  EXPECT_EQ(label(sweep, sweep_point(sweep, 1)), "course.side_m=5, calibration.method=heading, course.laps=3");
  EXPECT_EQ(label(sweep, sweep_point(sweep, 2)), "course.side_m=7, calibration.method=endpoint, course.laps=2");
}

TEST_F(SweepFile, SampledIntegersAreEquallyOften) {
  const Sweep sweep =
      read("design: latin_hypercube\nsamples: 400\naxes: {course.laps: {from: 2, to: 5, integer: true}}\n");
  std::map<std::string, int> counts;
  for (std::int64_t i = 0; i < sweep.points; ++i) ++counts[sweep_point(sweep, i).values[0].yaml];
  EXPECT_EQ(counts, (std::map<std::string, int>{{"2", 100}, {"3", 100}, {"4", 100}, {"5", 100}}));
}

TEST_F(SweepFile, APointIsTheScenarioWithItsValues) {
  const Sweep sweep = read(
      "set: {course.side_m: 3}\naxes:\n  effects.wheelbase.relative: [0.01]\n  robot: [optiodom.urdf]\n"
      "  noise: [{radius_scatter: 0.001}]\nreplicates: 2\n");
  const Scenario s = scenario_of(sweep, sweep_point(sweep, 1));
  EXPECT_EQ(s.course.side_m, 3);
  EXPECT_EQ(s.robot.urdf, "optiodom.urdf");
  EXPECT_EQ(s.noise.radius_scatter, 0.001);
  ASSERT_EQ(s.effects.size(), 1u);
  EXPECT_EQ(s.effects[0].values.numbers, std::vector<double>{0.01});
  EXPECT_EQ(s.seed, 6u) << "the second replicate has the next seed";
}

TEST_F(SweepFile, WhatDoesNotChangeResultsIsNoPartOfTheDefinition) {
  const std::string axes = "axes: {course.side_m: [1, 2]}\n";
  const std::string definition = read(axes).definition;
  EXPECT_EQ(
      read(axes + "name: other\ndescription: other\nexpect: {failed_points: {max: 0}}\nreport: {x: course.side_m}\n")
          .definition,
      definition);
  for (const char* other :
       {"axes: {course.side_m: [1, 3]}\n", "axes: {course.side_m: [1, 2]}\nreplicates: 2\n",
        "axes: {course.side_m: [1, 2]}\nseeds: own\n", "axes: {course.side_m: [1, 2]}\nset: {seed: 6}\n"}) {
    EXPECT_NE(read(other).definition, definition) << other;
  }
}

// figure_names() is made from an experiment that has everything; whatever a shipped scenario finds must be in it.
TEST(Figures, KnowEveryNumberOfTheSummary) {
  const std::set<std::string> known(figure_names().begin(), figure_names().end());
  EXPECT_EQ(known.size(), figure_names().size());
  for (const char* name : {"umbmark", "extended_umbmark", "uncertainty"}) {
    const Scenario scenario = read_scenario(std::string(UMBSIM_SOURCE_DIR) + "/scenarios/" + name + ".yaml",
                                            {"runs.per_direction=2", "course.side_m=1"});
    const ExperimentResult result = run_experiment(scenario, 0);
    Json summary = summary_json(result);
    summary["cost"].erase("wall_s");
    summary.erase("seed");
    const std::vector<Cell> figures = figures_of(result);
    std::size_t numbers = 1;  // `warnings`, which the summary has in words
    const Json flat = summary.flatten();
    for (const auto& [pointer, value] : flat.items()) {
      if (!value.is_number()) continue;
      std::string key = pointer.substr(1);
      for (char& c : key) c = c == '/' ? '.' : c;
      EXPECT_TRUE(known.count(key)) << key << " of summary.json is not among the figures: see complete_result()";
      ++numbers;
    }
    EXPECT_EQ(std::count_if(figures.begin(), figures.end(), [](const Cell& c) { return is_number(c); }),
              std::ptrdiff_t(numbers));
  }
}

}  // namespace
}  // namespace umbsim
