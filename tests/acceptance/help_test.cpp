// --help of every command: within 80 columns, with an example that the program takes; and what it says of misspelt
// words.
#include <regex>

#include "tests/acceptance/program.h"

namespace umbsim::acceptance {
namespace {

constexpr std::size_t kColumns = 80;

using Words = std::vector<std::string>;

std::string joined(const Words& words) {
  std::string text = "umbsim";
  for (const std::string& word : words) text += " " + word;
  return text;
}

/// The names below "Subcommands:" in a help text.
Words subcommands_in(const std::string& help) {
  Words names;
  const std::size_t begin = help.find("\nSubcommands:\n");
  std::istringstream lines(begin == std::string::npos ? "" : help.substr(begin + 1));
  std::string line;
  std::getline(lines, line);
  static const std::regex name("^  ([a-z]+)( .*)?$");
  std::smatch match;
  while (std::getline(lines, line) && !line.empty()) {
    if (std::regex_match(line, match, name)) names.push_back(match[1]);
  }
  return names;
}

/// Every command of the program, with its help.
void visit(const Desk& desk, const Words& path, std::map<Words, std::string>& found) {
  Words words = path;
  words.push_back("--help");
  const Outcome help = desk.umbsim(words);
  EXPECT_EQ(help.code, 0);
  EXPECT_EQ(help.err, "");
  found[path] = help.out;
  for (const std::string& name : subcommands_in(help.out)) {
    Words below = path;
    below.push_back(name);
    visit(desk, below, found);
  }
}

const std::map<Words, std::string>& all_help() {
  static const std::map<Words, std::string> help = [] {
    std::map<Words, std::string> found;
    visit(Desk(), {}, found);
    return found;
  }();
  return help;
}

TEST(Help, EveryCommandIsFound) {
  for (const Words& path : {Words{"run"}, Words{"list"}, Words{"sweep", "export"}, Words{"gap", "diagnose"},
                            Words{"gap", "trial", "score"}}) {
    EXPECT_TRUE(all_help().count(path)) << joined(path);
  }
  EXPECT_GE(all_help().size(), 16u);
}

TEST(Help, FitsTheScreen) {
  for (const auto& [path, help] : all_help()) {
    std::istringstream lines(help);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), kColumns) << joined(path) << ": " << line;
  }
}

// An example may need a result that is not there; then the program says so, and not how it is used.
TEST(Help, EveryCommandShowsAnExampleThatItTakes) {
  for (const auto& [path, help] : all_help()) {
    SCOPED_TRACE(joined(path));
    const std::size_t at = help.find("\nExample:\n  umbsim");
    ASSERT_NE(at, std::string::npos) << help;
    const std::string example = help.substr(at + std::string("\nExample:\n  ").size());
    EXPECT_EQ(example.rfind(joined(path), 0), 0u) << example;
    const Desk desk;
    fs::create_symlink(UMBSIM_PROGRAM, desk.home / "umbsim");
    const Outcome outcome = desk.shell("PATH=\"$PWD:$PATH\"; timeout 0.5 " + example);
    EXPECT_EQ(outcome.err.find("shows how it is used"), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.err.find("no shipped"), std::string::npos) << outcome.err;
    EXPECT_TRUE(outcome.code == 0 || outcome.code == 124 || outcome.code == kBadInput) << outcome.code << outcome.err;
  }
}

TEST(Help, TheWordHelpDoesTheSame) {
  const Desk desk;
  for (const auto& [path, help] : all_help()) {
    for (std::size_t at = 0; at <= path.size(); ++at) {
      Words words = path;
      words.insert(words.begin() + long(at), "help");
      const Outcome outcome = desk.umbsim(words);
      EXPECT_EQ(outcome.code, 0) << joined(words) << outcome.err;
      EXPECT_EQ(outcome.out, help) << joined(words);
    }
  }
  const Outcome unknown = desk.umbsim({"help", "gpa"});
  EXPECT_EQ(unknown.code, kBadInput);
  expect_says(unknown.err, {"unknown subcommand 'gpa'", "did you mean 'gap'?"});
}

TEST(Usage, MisspeltWordsSayWhatWasMeant) {
  const Desk desk;
  const std::vector<std::pair<Words, Words>> mistakes{
      {{"rnu"}, {"unknown subcommand 'rnu'", "did you mean 'run'?", "`umbsim --help`"}},
      {{"gap", "diagnos", "x"}, {"unknown subcommand 'diagnos' of `umbsim gap`", "did you mean 'diagnose'?"}},
      {{"gap", "trial", "genrate", "ci"}, {"'genrate' of `umbsim gap trial`", "did you mean 'generate'?"}},
      {{"gap", "trial", "genrate"}, {"genrate: cannot be read: No such file", "did you mean 'generate'?"}},
      {{"sweep", "exprot", "x"}, {"'exprot' of `umbsim sweep`", "did you mean 'export'?"}},
      {{"sweep", "mrege"}, {"mrege: cannot be read: No such file", "did you mean 'merge'?"}},
      {{"run", "umbmark", "--stet", "seed=1"}, {"unknown option '--stet' of `umbsim run`", "did you mean '--set'?"}},
      {{"run", "--forse"}, {"did you mean '--force'?", "`umbsim run --help`"}},
      {{"gap", "diagnose", "x", "--exclud=bump"}, {"unknown option '--exclud'", "did you mean '--exclude'?"}},
      {{"run", "umbmark", "second"}, {"'second'", "`umbsim run` has no use for this word"}},
      {{"gap", "predict", "x", "--scenari", "y"}, {"did you mean '--scenario'?"}},
      {{"gap", "diagnose", "x", "--exclude", "bmp"}, {"did you mean 'bump'?"}},
      {{"calibrate"}, {"recording is required", "`umbsim calibrate --help` shows how it is used"}}};
  for (const auto& [words, says] : mistakes) {
    SCOPED_TRACE(joined(words));
    const Outcome outcome = desk.umbsim(words);
    EXPECT_EQ(outcome.code, kBadInput);
    EXPECT_EQ(outcome.out, "");
    expect_says(outcome.err, says);
  }
  EXPECT_EQ(listing(desk.home), std::set<std::string>{});
}

// Figures are hundreds: the nearest few are named.
TEST(Usage, MisspeltFiguresSayWhatWasMeant) {
  const Desk desk;
  const std::string expecting = std::string(kShortScenario) + "expect:\n  ";
  desk.put("a.yaml", expecting + "umbmark.e_max_sist_m: {max: 1}\n");
  desk.put("b.yaml", expecting + "e_max_syst_m: {max: 1}\n");
  desk.put(
      "sweep.yaml",
      "format: umbsim-sweep/1\nscenario: short.yaml\naxes: {course.side_m: [0.5]}\nreport: {figure: umbmark.e_max}\n");
  desk.put("short.yaml", kShortScenario);
  for (const Words& words : {Words{"run", "a.yaml"}, Words{"run", "b.yaml"}, Words{"sweep", "sweep.yaml"}}) {
    const Outcome outcome = desk.umbsim(words);
    EXPECT_EQ(outcome.code, kBadInput);
    expect_says(outcome.err, {"did you mean 'umbmark.e_max_syst_m'?", "the nearest are: "});
    EXPECT_LT(outcome.err.size(), 500u) << "hundreds of names help nobody";
  }
}

}  // namespace
}  // namespace umbsim::acceptance
