// Where results go: never over a finished one unasked, whole or not at all.
#include <unistd.h>

#include "tests/acceptance/program.h"

namespace umbsim::acceptance {
namespace {

class OutputFolder : public testing::Test {
 protected:
  void SetUp() override { desk_.put("short.yaml", kShortScenario); }
  Outcome run(std::vector<std::string> options) {
    options.insert(options.begin(), {"run", "short.yaml"});
    return desk_.umbsim(options);
  }
  Desk desk_;
};

TEST_F(OutputFolder, AnExistingResultIsLeftAlone) {
  ASSERT_EQ(run({"--out", "a"}).code, 0);
  const auto before = files_of(desk_.home / "a");
  const Outcome again = run({"--out", "a", "--set", "seed=8"});
  EXPECT_EQ(again.code, kBadInput);
  expect_says(again.err, {"a: already holds a finished result", "--force", "--out"});
  EXPECT_TRUE(files_of(desk_.home / "a") == before);
  EXPECT_EQ(listing(desk_.home), (std::set<std::string>{"a", "short.yaml"}));
}

TEST_F(OutputFolder, ForceReplacesIt) {
  ASSERT_EQ(run({"--out", "a", "--set", "runs.per_direction=3"}).code, 0);
  const Outcome again = run({"--out", "a", "--force", "--set", "seed=8"});
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(json_of(desk_.home / "a/summary.json").at("seed"), 8);
  EXPECT_FALSE(fs::exists(desk_.home / "a/runs/cw-3")) << "the old result is gone as a whole";
  EXPECT_EQ(listing(desk_.home), (std::set<std::string>{"a", "short.yaml"}));
}

TEST_F(OutputFolder, ForceDoesNotReplaceWhatIsNotOurs) {
  desk_.put("mine/thesis.tex", "\\begin{document}");
  const Outcome outcome = run({"--out", "mine", "--force"});
  EXPECT_EQ(outcome.code, kBadInput);
  expect_says(outcome.err, {"mine: exists and is not a result of this program"});
  EXPECT_EQ(text_of(desk_.home / "mine/thesis.tex"), "\\begin{document}");
}

TEST_F(OutputFolder, AFileIsNotAFolder) {
  const Outcome outcome = run({"--out", "short.yaml", "--force"});
  EXPECT_EQ(outcome.code, kBadInput);
  expect_says(outcome.err, {"short.yaml: is not a folder"});
  EXPECT_EQ(text_of(desk_.home / "short.yaml"), kShortScenario);
}

TEST_F(OutputFolder, CalibrateKeepsTheSameRules) {
  ASSERT_EQ(run({"--out", "a"}).code, 0);
  ASSERT_EQ(desk_.umbsim({"calibrate", "a", "--out", "c"}).code, 0);
  EXPECT_EQ(desk_.umbsim({"calibrate", "a", "--out", "c"}).code, kBadInput);
  EXPECT_EQ(desk_.umbsim({"calibrate", "a", "--out", "c", "--force"}).code, 0);
  EXPECT_EQ(names_of(files_of(desk_.home / "c")),
            (std::set<std::string>{"calibration.yaml", "calibration.json", "provenance.json", "report.html"}));
  EXPECT_EQ(listing(desk_.home), (std::set<std::string>{"a", "c", "short.yaml"}));
}

// Root may write into folders that are read-only for others; a folder below a file is out of reach for everyone.
TEST_F(OutputFolder, BelowAFileTheRunFails) {
  const Outcome outcome = run({"--out", "short.yaml/a"});
  EXPECT_TRUE(outcome.code == kRunFailed || outcome.code == kBadInput) << outcome.code;
  expect_says(outcome.err, {"short.yaml/a", "Not a directory"});
  EXPECT_EQ(listing(desk_.home), std::set<std::string>{"short.yaml"});
}

TEST_F(OutputFolder, ReadOnlyTheRunFails) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write into read-only folders";
  fs::create_directory(desk_.home / "locked");
  fs::permissions(desk_.home / "locked", fs::perms::owner_read | fs::perms::owner_exec);
  const Outcome outcome = run({"--out", "locked/a"});
  fs::permissions(desk_.home / "locked", fs::perms::owner_all);
  EXPECT_TRUE(outcome.code == kRunFailed || outcome.code == kBadInput) << outcome.code;
  expect_says(outcome.err, {"locked/a", "Permission denied"});
  EXPECT_EQ(listing(desk_.home / "locked"), std::set<std::string>{});
}

// A limit on the size of files stands for a full disk: writing stops half-way through a file.
TEST_F(OutputFolder, WhenAFileCannotBeWrittenToItsEndNothingIsLeft) {
  ASSERT_EQ(run({"--out", "a"}).code, 0);
  const auto before = files_of(desk_.home / "a");
  const std::string limited = "trap '' XFSZ; ulimit -f 4; " + shell_quoted(UMBSIM_PROGRAM) + " run short.yaml ";
  for (const char* out : {"--out b", "--out a --force"}) {
    const Outcome outcome = desk_.shell(limited + out);
    EXPECT_EQ(outcome.code, kRunFailed) << outcome.out;
    expect_says(outcome.err, {"cannot be written completely", "File too large"});
    EXPECT_EQ(listing(desk_.home), (std::set<std::string>{"a", "short.yaml"}));
  }
  EXPECT_TRUE(files_of(desk_.home / "a") == before) << "the older result stays as it was";
}

TEST_F(OutputFolder, OnAFullDiskNothingIsLeft) {
  fs::create_directory(desk_.home / "disk");
  const std::string mount = "unshare --mount sh -c 'mount -t tmpfs -o size=64k tmpfs disk && ";
  if (desk_.shell(mount + "true'").code != 0) GTEST_SKIP() << "a small file system cannot be mounted here";
  const Outcome outcome = desk_.shell(mount + "{ \"$0\" run short.yaml --out disk/a; echo code $?; ls -A disk; }' " +
                                      shell_quoted(UMBSIM_PROGRAM));
  EXPECT_EQ(outcome.out, "code 3\n") << "and nothing in the listing of the disk";
  expect_says(outcome.err, {"disk/", "No space left on device"});
}

}  // namespace
}  // namespace umbsim::acceptance
