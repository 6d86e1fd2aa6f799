// How commands answer: what `umbsim` alone says, --json and --quiet for scripts, colours for people.
#include "tests/acceptance/program.h"

namespace umbsim::acceptance {
namespace {

using Words = std::vector<std::string>;

const char* const kEscape = "\033[";

/// A JSON text and nothing else.
json parsed(const Outcome& outcome) {
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  return json::parse(outcome.out);
}

/// Without what no two runs share.
json without_clock(json j) {
  j.at("cost").erase("wall_s");
  return j;
}

TEST(Start, TheProgramAloneSaysWhatMostPeopleWant) {
  const Desk desk;
  const Outcome alone = desk.umbsim({});
  EXPECT_EQ(alone.code, 0);
  EXPECT_EQ(alone.err, "");
  expect_says(alone.out, {"umbsim run ", "umbsim import ", "umbsim calibrate ", "umbsim gap diagnose ", "umbsim sweep ",
                          "umbsim --help"});
}

// In groups, and the same option in the same group everywhere.
TEST(Help, OptionsStandInGroups) {
  const Desk desk;
  for (const Words& command : {Words{"run"}, Words{"calibrate"}, Words{"gap", "diagnose"}}) {
    Words words = command;
    words.push_back("--help");
    const std::string help = desk.umbsim(words).out;
    const std::size_t input = help.find("\nInput:\n"), result = help.find("\nResult:\n"), work = help.find("\nWork:\n"),
                      last = help.find("\nHelp:\n");
    ASSERT_NE(last, std::string::npos) << help;
    EXPECT_TRUE(input < result && result < work && work < last) << help;
    const auto at = [&](const char* option) { return help.find(option); };
    EXPECT_TRUE(result < at("--out") && at("--json") < work && at("--quiet") < work) << help;
    EXPECT_TRUE(work < at("--jobs") && at("--jobs") < last && last < at("--help")) << help;
  }
}

TEST(Answer, JsonIsTheFileAndNothingElseIsWritten) {
  const Desk desk;
  desk.put("short.yaml", kShortScenario);
  ASSERT_EQ(desk.umbsim({"run", "short.yaml", "--out", "r"}).code, 0);
  ASSERT_EQ(desk.umbsim({"calibrate", "r", "--out", "c"}).code, 0);
  ASSERT_EQ(desk.umbsim({"gap", "diagnose", "r", "--out", "d", "--no-cache"}).code, 0);
  const std::set<std::string> before = listing(desk.home);
  EXPECT_EQ(without_clock(parsed(desk.umbsim({"run", "short.yaml", "--json"}))),
            without_clock(json_of(desk.home / "r/summary.json")));
  EXPECT_EQ(parsed(desk.umbsim({"calibrate", "r", "--json"})), json_of(desk.home / "c/calibration.json"));
  EXPECT_EQ(without_clock(parsed(desk.umbsim({"gap", "diagnose", "r", "--json", "--no-cache"}))),
            without_clock(json_of(desk.home / "d/diagnosis.json")));
  EXPECT_EQ(listing(desk.home), before);
}

TEST(Answer, JsonBesideAFolder) {
  const Desk desk;
  desk.put("short.yaml", kShortScenario);
  const json said = parsed(desk.umbsim({"run", "short.yaml", "--json", "--out", "r"}));
  EXPECT_EQ(said, json_of(desk.home / "r/summary.json"));
}

// The exit code alone says it, and standard error why.
TEST(Answer, JsonOfAnExpectationThatIsNotMet) {
  const Desk desk;
  desk.put("short.yaml", kShortScenario + std::string("expect: {umbmark.e_max_syst_m: {max: 1e-9}}\n"));
  const Outcome outcome = desk.umbsim({"run", "short.yaml", "--json"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_TRUE(json::parse(outcome.out).contains("umbmark"));
  expect_says(outcome.err, {"an expectation was not met"});
}

TEST(Answer, QuietSaysNothingButErrors) {
  const Desk desk;
  desk.put("short.yaml", kShortScenario);
  for (const Words& words : {Words{"run", "short.yaml", "--out", "r", "--quiet"}, Words{"calibrate", "r", "-q"}}) {
    const Outcome outcome = desk.umbsim(words);
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(outcome.out + outcome.err, "");
  }
  const Outcome on_terminal =
      desk.shell("script -qec \"" + std::string(UMBSIM_PROGRAM) + " run umbmark --quiet --out t\" /dev/null");
  EXPECT_EQ(on_terminal.out, "") << "progress is silent, too";
  const Outcome wrong = desk.umbsim({"run", "missing.yaml", "--quiet"});
  EXPECT_EQ(wrong.code, 2);
  expect_says(wrong.err, {"missing.yaml"});
  expect_says(desk.umbsim({"run", "short.yaml", "--quiet", "--json"}).err, {"--quiet", "--json"});
}

/// What a terminal gets.
std::string on_terminal(const Desk& desk, const std::string& words, const std::string& environment) {
  return desk
      .shell("TERM=xterm " + environment + " script -qec \"" + std::string(UMBSIM_PROGRAM) + " " + words +
             "\" /dev/null")
      .out;
}

TEST(Colour, OnATerminalOnly) {
  const Desk desk;
  desk.put("short.yaml", kShortScenario + std::string("expect: {umbmark.e_max_syst_m: {max: 1e-9}}\n"));
  EXPECT_EQ(desk.umbsim({"run", "short.yaml", "--out", "p"}).out.find(kEscape), std::string::npos);
  const std::string run = on_terminal(desk, "run short.yaml --out t", "");
  expect_says(run, {"\033[1;31mNOT MET\033[0m", "\033[1mResult in \033[0m", "\033[1;31mumbsim:\033[0m"});
  const std::string none = on_terminal(desk, "run short.yaml --out n", "NO_COLOR=1");
  expect_says(none, {"NOT MET"});
  EXPECT_EQ(none.find("\033[1"), std::string::npos) << none;
  expect_says(on_terminal(desk, "run --help", ""), {"\033[1mResult:\033[0m", "\033[1m--json\033[0m"});
  EXPECT_EQ(on_terminal(desk, "run --help", "NO_COLOR=1").find(kEscape), std::string::npos);
}

}  // namespace
}  // namespace umbsim::acceptance
