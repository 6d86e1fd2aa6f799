// Where results go that nobody named a folder for: the next free one below results/, and `latest` is the newest.
#include "tests/acceptance/program.h"

namespace umbsim::acceptance {
namespace {

class DefaultFolder : public testing::Test {
 protected:
  void SetUp() override { desk_.put("short.yaml", kShortScenario); }
  Outcome run(std::vector<std::string> options = {}) {
    options.insert(options.begin(), {"run", "short.yaml"});
    return desk_.umbsim(options);
  }
  fs::path results(const std::string& name) const { return desk_.home / "results" / name; }
  std::string latest() const { return fs::read_symlink(results("latest")); }
  int seed(const std::string& name) const { return json_of(results(name) / "summary.json").at("seed"); }
  Desk desk_;
};

TEST_F(DefaultFolder, EveryRunGetsTheNextOne) {
  const Outcome first = run();
  ASSERT_EQ(first.code, 0) << first.err;
  expect_says(first.out, {"Result in results/short: open results/short/report.html"});
  const auto before = files_of(results("short"));
  for (int n = 2; n <= 3; ++n) {
    const std::string name = "short-" + std::to_string(n), kept = n == 2 ? "short" : "short-2";
    const Outcome again = run({"--set", "seed=" + std::to_string(n)});
    ASSERT_EQ(again.code, 0) << again.err;
    EXPECT_EQ(again.err, "");
    expect_says(again.out, {"Result in results/" + name + " (results/" + kept + " is kept): open results/" + name +
                            "/report.html"});
    EXPECT_EQ(seed(name), n);
    EXPECT_EQ(latest(), name) << "a relative link";
    EXPECT_EQ(seed("latest"), n);
  }
  EXPECT_TRUE(files_of(results("short")) == before);
  EXPECT_EQ(listing(results("")), (std::set<std::string>{"index.html", "latest", "short", "short-2", "short-3"}));
}

TEST_F(DefaultFolder, ForceReplacesTheFirst) {
  ASSERT_EQ(run().code, 0);
  ASSERT_EQ(run().code, 0);
  ASSERT_EQ(run({"--force", "--set", "seed=8"}).code, 0);
  EXPECT_EQ(seed("short"), 8);
  EXPECT_EQ(seed("short-2"), 7);
  EXPECT_EQ(latest(), "short");
}

TEST_F(DefaultFolder, AFolderThatIsFreeAgainIsUsedAndAnyOtherIsLeftAlone) {
  fs::create_directories(results("short"));
  desk_.put("results/short-2", "a file of mine");
  ASSERT_EQ(run().code, 0) << "an empty folder is free";
  EXPECT_EQ(seed("short"), 7);
  fs::create_directory_symlink("nowhere", results("short-3"));
  ASSERT_EQ(run().code, 0);
  EXPECT_EQ(latest(), "short-4");
  EXPECT_EQ(text_of(results("short-2")), "a file of mine");
}

TEST_F(DefaultFolder, AFailedRunMovesNothing) {
  ASSERT_EQ(run().code, 0);
  const std::string limited = "trap '' XFSZ; ulimit -f 4; " + shell_quoted(UMBSIM_PROGRAM) + " run short.yaml ";
  EXPECT_EQ(desk_.shell(limited).code, kRunFailed);
  EXPECT_EQ(run({"--set", "course.side_m=-1"}).code, kBadInput);
  EXPECT_EQ(latest(), "short");
  EXPECT_EQ(listing(results("")), (std::set<std::string>{"index.html", "latest", "short"}));
}

TEST_F(DefaultFolder, ManyAtOnceLoseNothing) {
  std::string line;
  for (int i = 1; i <= 6; ++i) {
    line += shell_quoted(UMBSIM_PROGRAM) + " run short.yaml -j 1 --set seed=" + std::to_string(i) + " & ";
  }
  const Outcome all = desk_.shell(line + "wait");
  EXPECT_EQ(all.err, "");
  std::set<int> seeds;
  for (int n = 1; n <= 6; ++n) seeds.insert(seed(n == 1 ? "short" : "short-" + std::to_string(n)));
  EXPECT_EQ(seeds, (std::set<int>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(listing(results("")).size(), 8u) << "and `latest`, and the list of results";
}

TEST_F(DefaultFolder, LatestAndReferenceAreNobodysFolders) {
  desk_.put("results/reference/figures.json", "{}");
  for (const std::string name : {"latest", "reference"}) {
    ASSERT_EQ(run({"--set", "name=" + name}).code, 0);
    ASSERT_EQ(run({"--set", "name=" + name, "--force"}).code, 0);
    EXPECT_EQ(latest(), name + "-2");
  }
  EXPECT_EQ(names_of(files_of(results("reference"))), std::set<std::string>{"figures.json"});
  const Outcome outcome = run({"--out", "results/latest", "--force"});
  EXPECT_EQ(outcome.code, kBadInput);
  expect_says(outcome.err, {"results/latest: is the link to the newest result"});
  EXPECT_EQ(latest(), "reference-2");
}

TEST_F(DefaultFolder, ALatestOfOnesOwnStays) {
  desk_.put("results/latest/notes.txt", "mine");
  ASSERT_EQ(run().code, 0);
  EXPECT_EQ(text_of(results("latest") / "notes.txt"), "mine");
  EXPECT_EQ(seed("short"), 7);
}

TEST_F(DefaultFolder, ANamedFolderIsStillRefused) {
  ASSERT_EQ(run({"--out", "results/mine"}).code, 0);
  EXPECT_EQ(latest(), "mine") << "it is below results/, too";
  const Outcome again = run({"--out", "results/mine"});
  EXPECT_EQ(again.code, kBadInput);
  expect_says(again.err, {"results/mine: already holds a finished result", "--force"});
  ASSERT_EQ(run({"--out", "elsewhere"}).code, 0);
  EXPECT_EQ(latest(), "mine");
}

TEST_F(DefaultFolder, CommandsOnRecordingsDoTheSame) {
  ASSERT_EQ(run().code, 0);
  for (const char* name : {"short-calibration", "short-calibration-2"}) {
    const Outcome outcome = desk_.umbsim({"calibrate", "results/short"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    expect_says(outcome.out, {std::string("Result in results/") + name});
    EXPECT_EQ(latest(), name);
  }
  ASSERT_EQ(run().code, 0);
  ASSERT_EQ(desk_.umbsim({"calibrate", "results/latest/"}).code, 0);
  EXPECT_EQ(latest(), "short-2-calibration") << "named after the result, not after the link";
  for (const char* name : {"short-prediction", "short-prediction-2"}) {
    const Outcome outcome = desk_.umbsim({"gap", "predict", "results/short", "--scenario", "short.yaml"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(latest(), name);
  }
}

}  // namespace
}  // namespace umbsim::acceptance
