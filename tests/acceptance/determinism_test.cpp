#include "tests/acceptance/program.h"

namespace umbsim::acceptance {
namespace {

/// The folder's files; the time on the clock, which may differ, taken out of summary.json and seen to be there.
std::map<std::string, std::string> reproducible(const fs::path& folder) {
  auto files = files_of(folder);
  std::string& summary = files.at("summary.json");
  const std::size_t at = summary.find("\"wall_s\":");
  EXPECT_NE(at, std::string::npos);
  summary.erase(at, summary.find('\n', at) - at);
  return files;
}

// Noise, cables and a calibration pass: everything random and everything parallel.
class SameSeed : public testing::Test {
 protected:
  void SetUp() override {
    desk_.put("short.yaml", std::string(kShortScenario) + "bumps: {count: 3, height_m: 0.006}\n");
  }
  std::map<std::string, std::string> run(const std::vector<std::string>& options) {
    std::vector<std::string> words{"run", "short.yaml", "--force", "--out", "a"};
    words.insert(words.end(), options.begin(), options.end());
    const Outcome outcome = desk_.umbsim(words);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return reproducible(desk_.home / "a");
  }
  Desk desk_;
};

TEST_F(SameSeed, SameBytesWhateverTheNumberOfJobs) {
  const auto one = run({"--jobs", "1"});
  ASSERT_GT(one.size(), 20u);
  for (const char* jobs : {"2", "5", "1"}) {
    const auto other = run({"--jobs", jobs});
    EXPECT_EQ(names_of(one), names_of(other));
    for (const auto& [name, text] : one) EXPECT_TRUE(text == other.at(name)) << name << " differs with --jobs " << jobs;
  }
}

TEST_F(SameSeed, AnotherSeedGivesOtherRuns) {
  const auto one = run({});
  const auto other = run({"--set", "seed=8"});
  EXPECT_TRUE(one.at("runs/cw-1/truth.csv") != other.at("runs/cw-1/truth.csv"));
}

TEST_F(SameSeed, RunsOfOneDirectionDifferByTheirNoise) {
  const auto one = run({});
  EXPECT_TRUE(one.at("runs/cw-1/truth.csv") != one.at("runs/cw-2/truth.csv"));
}

// More runs do not change the ones before: every run has random streams of its own.
TEST_F(SameSeed, MoreRunsLeaveTheFirstOnesAlone) {
  const auto two = run({"--set", "runs.per_direction=2"});
  const auto three = run({"--set", "runs.per_direction=3"});
  for (const char* name : {"runs/cw-1/encoders.csv", "runs/ccw-2/truth.csv"}) {
    EXPECT_TRUE(two.at(name) == three.at(name)) << name;
  }
}

}  // namespace
}  // namespace umbsim::acceptance
