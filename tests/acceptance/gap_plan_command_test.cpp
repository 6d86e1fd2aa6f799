// `gap plan` as its user calls it: a scenario or a recording in, a prediction out, nothing measured needed.
#include "tests/acceptance/program.h"

namespace umbsim::acceptance {
namespace {

double probability(const json& confusion, const std::string& truth, const std::string& named) {
  for (std::size_t i = 0; i < confusion["truth"].size(); ++i) {
    if (confusion["truth"][i] != truth) continue;
    for (std::size_t j = 0; j < confusion["named"].size(); ++j) {
      if (confusion["named"][j] == named) return confusion["probability"][i][j];
    }
  }
  ADD_FAILURE() << "no " << truth << " / " << named;
  return -1;
}

TEST(GapPlan, GeometryIsToldApartOnPlainSquares) {
  const Desk desk;
  desk.put("s.yaml", kShortScenario);
  const Outcome o = desk.umbsim({"gap", "plan", "s.yaml", "--effects", "wheelbase,wheel_radius_difference",
                                 "--no-cache", "--severity", "5", "--out", "p"});
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(o.err, "") << "quiet in a pipe";
  const json plan = json_of(desk.home / "p/plan.json");
  EXPECT_EQ(plan["format"], "umbsim-gap-plan/1");
  const json& confusion = plan["these_runs"]["confusion"];
  // Turns and curved legs have nothing in common on squares driven both ways.
  EXPECT_GT(probability(confusion, "wheelbase", "wheelbase"), 0.9);
  EXPECT_GT(probability(confusion, "wheel_radius_difference", "wheel_radius_difference"), 0.9);
  EXPECT_TRUE(plan["these_runs"]["indistinguishable"].empty());
}

TEST(GapPlan, SameBytesAgain) {
  const Desk desk;
  desk.put("s.yaml", kShortScenario);
  for (const char* out : {"a", "b"}) {
    ASSERT_EQ(desk.umbsim({"gap", "plan", "s.yaml", "--effects", "wheelbase,backlash", "--out", out}).code, 0);
  }
  EXPECT_EQ(text_of(desk.home / "a/plan.json"), text_of(desk.home / "b/plan.json"));
}

TEST(GapPlan, BadInputIsNamed) {
  const Desk desk;
  desk.put("s.yaml", kShortScenario);
  EXPECT_EQ(desk.umbsim({"gap", "plan"}).code, kBadInput);
  EXPECT_EQ(desk.umbsim({"gap", "plan", "nothing.yaml"}).code, kBadInput);
  const Outcome unknown = desk.umbsim({"gap", "plan", "s.yaml", "--effects", "wheelbase,gravity"});
  EXPECT_EQ(unknown.code, kBadInput);
  EXPECT_NE(unknown.err.find("gravity"), std::string::npos);
  EXPECT_EQ(desk.umbsim({"gap", "plan", "s.yaml", "--effects", "wheelbase"}).code, kBadInput);
  EXPECT_EQ(desk.umbsim({"gap", "plan", "s.yaml", "--severity", "-1"}).code, kBadInput);
  EXPECT_FALSE(fs::exists(desk.home / "results")) << "nothing half written";
}

}  // namespace
}  // namespace umbsim::acceptance
