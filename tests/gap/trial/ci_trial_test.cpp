// The whole trial with the real program: twenty cases are drawn, driven, sealed, diagnosed and scored. The bars are
// loose: they catch a diagnosis that broke, not one that is a little worse (docs/trial.md has the published figures).
#include <fmt/format.h>

#include "tests/acceptance/program.h"

namespace umbsim {
namespace {

using acceptance::json;

constexpr int kCases = 20;
constexpr int kMostFalseAlarms = 1;      // of 4
constexpr int kFewestSinglesRight = 6;   // of 9
constexpr double kLeastInSet = 0.66;
constexpr double kMostParameterError = 0.15;
constexpr double kLeastP = 0.01;         // of the metadata's guesses against chance

TEST(CiTrial, TwentyCasesOfTheSimulatorItself) {
  const acceptance::Desk desk;
  const acceptance::Outcome o =
      desk.umbsim({"gap", "trial", UMBSIM_SOURCE_DIR "/scenarios/trials/ci.yaml", "--out", "trial"});
  ASSERT_EQ(o.code, 0) << o.err;
  fmt::print("{}\n", o.out);
  const json s = acceptance::json_of(desk.home / "trial/score/summary.json");
  EXPECT_EQ(s["cases"], kCases);
  EXPECT_TRUE(s["sealed_before_diagnosis"]);
  EXPECT_LE(s["figures"]["false_alarm"]["hits"], kMostFalseAlarms);
  EXPECT_GE(s["by_tier"]["single"]["right"], kFewestSinglesRight);
  EXPECT_GE(s["figures"]["truth_in_set"]["value"], kLeastInSet);
  EXPECT_LE(s["figures"]["parameter_error"]["value"], kMostParameterError);
  EXPECT_GT(s["leaks"]["metadata"]["p_value"], kLeastP);
  // Naming the truth beats naming what another case's truth was.
  EXPECT_GT(s["leaks"]["shuffled_labels"]["accuracy"], s["leaks"]["shuffled_labels"]["chance"]);
  for (const json& v : s["verdicts"]) EXPECT_FALSE(v.value("failed", false)) << v["name"];
}

}  // namespace
}  // namespace umbsim
