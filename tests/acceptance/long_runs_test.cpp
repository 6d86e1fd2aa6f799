// Long experiments: memory, the disk, and stopping them.
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <iostream>

#include "tests/acceptance/program.h"

namespace umbsim::acceptance {
namespace {

// The most memory that the program had, in MB.
double peak_mb(const Desk& desk, const std::vector<std::string>& words) {
  std::vector<std::string> all{UMBSIM_PROGRAM};
  all.insert(all.end(), words.begin(), words.end());
  std::vector<char*> argv;
  for (std::string& word : all) argv.push_back(word.data());
  argv.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    if (chdir(desk.home.c_str()) != 0 || !std::freopen("/dev/null", "w", stdout)) _exit(127);
    execv(argv[0], argv.data());
    _exit(127);
  }
  int status = 0;
  rusage used{};
  EXPECT_EQ(wait4(child, &status, 0, &used), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  return double(used.ru_maxrss) / 1024;
}

// Rows take some 4 kB a simulated second in memory: 40 laps here more than 40 MB.
TEST(LongRuns, MemoryDoesNotGrowWithLaps) {
  const Desk desk;
  const auto peak = [&](int laps) {
    return peak_mb(desk, {"run", shipped("umbmark"), "--out", "out" + std::to_string(laps), "-j", "2", "--set",
                          "runs.per_direction=2", "--set", "course.laps=" + std::to_string(laps)});
  };
  const double one = peak(1), many = peak(40);
  std::cout << "one lap " << one << " MB, 40 laps " << many << " MB\n";
  EXPECT_LT(many, one + 8);
}

TEST(LongRuns, AreRefusedWhereTheDiskHasNoRoom) {
  const Desk desk;
  const Outcome outcome = desk.umbsim({"run", shipped("umbmark"), "--out", "out", "--set", "course.laps=1000", "--set",
                                       "runs.per_direction=1000", "--set", "encoders.rate_hz=10000"});
  EXPECT_EQ(outcome.code, kRunFailed);
  expect_says(outcome.err, {"2000 runs of 1000 laps", "MB are free"});
  EXPECT_EQ(listing(desk.home), std::set<std::string>{});
}

// One signal, as soon as anything is there: a second one ends the program at once, and `timeout` sends two.
TEST(LongRuns, CtrlCLeavesNothing) {
  const Desk desk;
  const Outcome outcome = desk.shell(shell_quoted(UMBSIM_PROGRAM) + " run " + shell_quoted(shipped("umbmark")) +
                                     " --out out --set course.laps=1000 & program=$!\n"
                                     "while [ -z \"$(ls -A)\" ] && kill -0 $program; do :; done\n"
                                     "kill -INT $program; wait $program");
  EXPECT_EQ(outcome.code, 128 + SIGINT);
  expect_says(outcome.err, {"stopped; nothing was written"});
  EXPECT_EQ(listing(desk.home), std::set<std::string>{});
}

}  // namespace
}  // namespace umbsim::acceptance
