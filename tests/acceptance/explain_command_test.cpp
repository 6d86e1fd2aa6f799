#include "tests/acceptance/program.h"

namespace umbsim::acceptance {
namespace {

TEST(ExplainCommand, ShowsWhoCausesWhatAndWritesNothing) {
  const Desk desk;
  const Outcome outcome = desk.umbsim({"explain", shipped("unidirectional_trap"), "--set", "course.side_m=1"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  expect_says(outcome.out, {"wheelbase", "wheel_radius_difference", "interaction", "the scenario", "cw", "ccw"});
  EXPECT_EQ(listing(desk.home), std::set<std::string>{});
}

TEST(ExplainCommand, WritesAFolderWhereItIsAskedTo) {
  const Desk desk;
  desk.put("short.yaml", kShortScenario);
  const std::vector<std::string> words{"explain", "short.yaml", "--out", "a"};
  ASSERT_EQ(desk.umbsim(words).code, 0);
  EXPECT_EQ(listing(desk.home / "a"), (std::set<std::string>{"explain.json", "labmate.urdf", "provenance.json",
                                                             "report.html", "scenario.resolved.yaml"}));
  const json e = json_of(desk.home / "a/explain.json");
  EXPECT_EQ(e.at("format"), "umbsim-explanation/1");
  ASSERT_EQ(e.at("effects").size(), 1u);
  EXPECT_EQ(e.at("effects")[0].at("name"), "wheelbase");
  for (const char* direction : {"cw", "ccw"}) {
    EXPECT_GT(e.at("effects")[0].at("alone").at(direction).at("distance_m"), 0.001);
    EXPECT_EQ(e.at("interaction").at(direction).at("distance_m"), 0);
  }
  EXPECT_EQ(desk.umbsim(words).code, kBadInput) << "a finished result stays";
  EXPECT_EQ(desk.umbsim({"explain", "short.yaml", "--out", "a", "--force"}).code, 0);
}

TEST(ExplainCommand, BadScenariosAreRefused) {
  const Desk desk;
  EXPECT_EQ(desk.umbsim({"explain"}).code, kBadInput);
  const Outcome outcome = desk.umbsim({"explain", shipped("nominal"), "--set", "effects.wheelbas.relative=1"});
  EXPECT_EQ(outcome.code, kBadInput);
  expect_says(outcome.err, {"did you mean 'wheelbase'"});
}

}  // namespace
}  // namespace umbsim::acceptance
