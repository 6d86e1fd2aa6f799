#include "tests/acceptance/program.h"

namespace umbsim::acceptance {
namespace {

TEST(CommandLine, HelpOfEverySubcommand) {
  const Desk desk;
  const Outcome top = desk.umbsim({"--help"});
  EXPECT_EQ(top.code, 0);
  EXPECT_EQ(top.err, "");
  for (const std::string command : {"run", "calibrate", "effects", "explain"}) {
    expect_says(top.out, {command});
    const Outcome help = desk.umbsim({command, "--help"});
    EXPECT_EQ(help.code, 0);
    EXPECT_EQ(help.err, "");
    expect_says(help.out, {"Usage: umbsim " + command, "--help"});
  }
  expect_says(top.out, {"Exit codes"});
}

TEST(CommandLine, Version) {
  const Outcome version = Desk().umbsim({"--version"});
  EXPECT_EQ(version.code, 0);
  expect_says(version.out, {"umbsim 0.", "Bullet 3."});
}

TEST(CommandLine, UnknownSubcommandListsTheKnown) {
  const Outcome outcome = Desk().umbsim({"calibrat"});
  EXPECT_EQ(outcome.code, kBadInput);
  EXPECT_EQ(outcome.out, "");
  expect_says(outcome.err, {"unknown subcommand 'calibrat'", "did you mean 'calibrate'?",
                            "run, import, calibrate, export, report, list, robot, effects"});
}

TEST(CommandLine, MistakesAreUsageErrors) {
  const Desk desk;
  const std::vector<std::pair<std::vector<std::string>, std::string>> mistakes{
      {{"run", "--bogus"}, "--bogus"},
      {{"run", shipped("nominal"), "--jobs", "-1"}, "--jobs"},
      {{"run", shipped("nominal"), "--jobs", "many"}, "--jobs"},
      {{"run", shipped("nominal"), "second.yaml"}, "second.yaml"},
      {{"calibrate"}, "recording"},
      {{"calibrate", "x", "--method", "guess"}, "--method"}};
  for (const auto& [words, named] : mistakes) {
    const Outcome outcome = desk.umbsim(words);
    EXPECT_EQ(outcome.code, kBadInput);
    EXPECT_EQ(outcome.out, "");
    expect_says(outcome.err, {named});
  }
  EXPECT_EQ(listing(desk.home), std::set<std::string>{});
}

TEST(CommandLine, EffectsAreListedAndDescribed) {
  const Desk desk;
  const Outcome list = desk.umbsim({"effects"});
  EXPECT_EQ(list.code, 0);
  EXPECT_EQ(list.err, "");
  for (const std::string effect : {"wheel_radius_difference", "wheel_radius_scale", "wheelbase"}) {
    expect_says(list.out, {effect});
    const Outcome one = desk.umbsim({"effects", effect});
    EXPECT_EQ(one.code, 0);
    expect_says(one.out, {effect, "neutral", "plausible", "allowed", "source"});
  }
  const Outcome unknown = desk.umbsim({"effects", "wheelbas"});
  EXPECT_EQ(unknown.code, kBadInput);
  expect_says(unknown.err, {"unknown effect 'wheelbas'", "did you mean 'wheelbase'?"});
}

}  // namespace
}  // namespace umbsim::acceptance
