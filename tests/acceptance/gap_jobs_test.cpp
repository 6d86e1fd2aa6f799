// `-j` of the commands that diagnose: how many threads, and never another result.
#include "tests/acceptance/program.h"

namespace umbsim::acceptance {
namespace {

/// What a diagnosis wrote, but for the one number that is not the same bytes.
std::map<std::string, std::string> results_of(const fs::path& folder) {
  auto files = files_of(folder);
  json diagnosis = json::parse(files.at("diagnosis.json"));
  EXPECT_TRUE(diagnosis.at("cost").contains("wall_s"));
  diagnosis.at("cost").erase("wall_s");
  files["diagnosis.json"] = diagnosis.dump();
  return files;
}

class GapJobs : public testing::Test {
 protected:
  void SetUp() override {
    desk.put("s.yaml", kShortScenario);
    ASSERT_EQ(desk.umbsim({"run", "s.yaml", "--out", "r"}).code, 0);
  }
  const Desk desk;
};

TEST_F(GapJobs, AnyNumberOfThreadsGivesTheSameBytes) {
  for (const char* jobs : {"1", "3"}) {
    const Outcome o = desk.umbsim({"gap", "diagnose", "r", "--no-cache", "-j", jobs, "--out", jobs});
    ASSERT_EQ(o.code, 0) << o.err;
    EXPECT_EQ(o.err, "") << "quiet in a pipe";
  }
  EXPECT_EQ(results_of(desk.home / "1"), results_of(desk.home / "3"));
}

TEST_F(GapJobs, OneJobIsOneThread) {
  const std::string program = shell_quoted(UMBSIM_PROGRAM);
  const auto most_threads = [&](const std::string& before, const std::string& words) {
    const Outcome o =
        desk.shell(before + " " + program + " gap diagnose r --no-cache --force --out d " + words +
                   " > /dev/null & p=$!; while kill -0 $p 2> /dev/null; do "
                   "sed -n 's/^Threads:[^0-9]*//p' /proc/$p/status 2> /dev/null; sleep 0.02; done; wait $p");
    EXPECT_EQ(o.code, 0) << o.err;
    std::istringstream seen(o.out);
    int most = 0;
    for (int n = 0; seen >> n;) most = std::max(most, n);
    return most;
  };
  EXPECT_EQ(most_threads("", "-j 1"), 1);
  EXPECT_EQ(most_threads("UMBSIM_JOBS=1", ""), 1) << "as a trial says it";
  EXPECT_GE(most_threads("UMBSIM_JOBS=1", "-j 3"), 2) << "what is typed goes first";
}

TEST_F(GapJobs, ATrialSharesItsJobsAmongItsCases) {
  desk.put("t.yaml",
           "format: umbsim-trial/1\nname: short\ndescription: Short drives\nseed: 4\ncases: {no_effect: 2}\n"
           "effects: [wheelbase]\nplatforms: {count: 1, side_m: [1, 1], linear_speed_mps: [0.4, 0.4], "
           "angular_speed_radps: [1.4, 1.4]}\nruns:\n  - {id: cw-1, direction: cw}\n  - {id: ccw-1, direction: ccw}\n");
  ASSERT_EQ(desk.umbsim({"gap", "trial", "generate", "t.yaml", "--out", "t"}).code, 0);
  const fs::path says = desk.put(
      "says.sh", "#!/bin/sh\necho \"$UMBSIM_JOBS\" >> " + shell_quoted((desk.home / "jobs").string()) + "\nexit 3\n");
  fs::permissions(says, fs::perms::owner_all);
  for (const char* jobs : {"1", "5"}) {
    ASSERT_EQ(desk.umbsim({"gap", "trial", "diagnose", "t", "--program", says.string(), "-j", jobs, "--retry"}).code,
              0);
  }
  EXPECT_EQ(text_of(desk.home / "jobs"), "1\n1\n2\n2\n");
}

TEST_F(GapJobs, BadNumbersAreRefused) {
  for (const char* command : {"diagnose", "plan", "predict"}) {
    EXPECT_EQ(desk.umbsim({"gap", command, "r", "-j", "-1"}).code, kBadInput) << command;
    EXPECT_EQ(desk.umbsim({"gap", command, "r", "-j", "many"}).code, kBadInput) << command;
  }
}

}  // namespace
}  // namespace umbsim::acceptance
