// Whatever happens to a sweep, what it holds in the end is what an undisturbed one holds.
#include <chrono>
#include <random>
#include <thread>

#include "tests/acceptance/sweep_program.h"

namespace umbsim::acceptance {
namespace {

constexpr int kKillsOfSweeps = 20;
// Seconds of work: most kills hit it at work.
constexpr int kWheelbases = 200;

void pause_s(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

class Interrupted : public testing::Test {
 protected:
  void SetUp() override {
    desk_.put("tiny.yaml", kTinyScenario);
    desk_.put("tiny_sweep.yaml", tiny_sweep(kWheelbases));
  }
  std::string undisturbed(const std::string& jobs = "0") {
    EXPECT_EQ(desk_.umbsim({"sweep", "tiny_sweep.yaml", "--out", "undisturbed", "--jobs", jobs, "--force"}).code, 0);
    return content_of(desk_.home / "undisturbed/sweep.sqlite");
  }
  int finish(const std::string& folder) { return desk_.umbsim({"sweep", "tiny_sweep.yaml", "--out", folder}).code; }
  Desk desk_;
};

TEST_F(Interrupted, KilledTwentyTimesAtRandom) {
  const auto begin = std::chrono::steady_clock::now();
  const std::string expected = undisturbed();
  const double whole_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const unsigned seed = std::random_device{}();
  SCOPED_TRACE("random moments from seed " + std::to_string(seed));
  std::mt19937 random(seed);
  const fs::path store = desk_.home / "killed/sweep.sqlite";
  std::int64_t before = 0;
  int kept = 0;
  for (int kills = 0; kills < kKillsOfSweeps; ++kills) {
    Running program(desk_, {"sweep", "tiny_sweep.yaml", "--out", "killed"});
    // On average two sweeps' worth of work in all: some kills hit right after the start, some find it finished.
    pause_s(std::uniform_real_distribution<>(0, whole_s / 5)(random));
    program.signal(SIGKILL);
    program.wait();
    if (!fs::exists(store)) continue;
    Database database(store, Database::Mode::read);
    EXPECT_EQ(text_of_cell(database.value("PRAGMA integrity_check")), "ok");
    if (number_of(database.value("SELECT count(*) FROM sqlite_schema WHERE name = 'points'")) == 0) continue;
    const std::int64_t after = points_in(store);
    EXPECT_GE(after, before) << "a finished point was lost";
    kept += after > before;
    before = after;
    if (after == 2 * kWheelbases) {
      EXPECT_TRUE(content_of(store) == expected);
      fs::remove_all(desk_.home / "killed");
      before = 0;
    }
  }
  EXPECT_GE(kept, 3) << "hardly any kill hit the sweep at work";
  ASSERT_EQ(finish("killed"), 0);
  EXPECT_TRUE(content_of(store) == expected);
}

TEST_F(Interrupted, TwoProcessesShareOneSweep) {
  const std::string expected = undisturbed();
  Running one(desk_, {"sweep", "tiny_sweep.yaml", "--out", "shared"});
  Running two(desk_, {"sweep", "tiny_sweep.yaml", "--out", "shared"});
  EXPECT_EQ(one.wait(), 0);
  EXPECT_EQ(two.wait(), 0);
  EXPECT_TRUE(content_of(desk_.home / "shared/sweep.sqlite") == expected);
}

TEST_F(Interrupted, OneOfTwoIsKilledAndTheOtherDoesItsPoints) {
  const std::string expected = undisturbed();
  Running one(desk_, {"sweep", "tiny_sweep.yaml", "--out", "shared"});
  Running two(desk_, {"sweep", "tiny_sweep.yaml", "--out", "shared"});
  pause_s(0.2);
  one.signal(SIGKILL);
  EXPECT_EQ(two.wait(), 0);
  EXPECT_TRUE(content_of(desk_.home / "shared/sweep.sqlite") == expected);
}

// The file comes before its table.
std::int64_t points_so_far(const fs::path& store) {
  if (!fs::exists(store)) return 0;
  try {
    return points_in(store);
  } catch (const std::exception&) {
    return 0;
  }
}

TEST_F(Interrupted, CtrlCStopsCleanly) {
  const std::string expected = undisturbed();
  for (const int signal : {SIGINT, SIGTERM}) {
    const std::string folder = "stopped" + std::to_string(signal);
    Running program(desk_, {"sweep", "tiny_sweep.yaml", "--out", folder});
    const fs::path store = desk_.home / folder / "sweep.sqlite";
    while (points_so_far(store) == 0) pause_s(0.002);
    program.signal(signal);
    EXPECT_EQ(program.wait(), 128 + signal);
    const std::int64_t done = points_in(store);
    EXPECT_GT(done, 0);
    EXPECT_LT(done, 2 * kWheelbases) << "it was stopped before the end";
    EXPECT_FALSE(fs::exists(desk_.home / folder / "report.html"));
    EXPECT_EQ(finish(folder), 0);
    EXPECT_TRUE(content_of(store) == expected);
  }
}

TEST_F(Interrupted, AnyNumberOfJobsGivesTheSame) {
  const std::string expected = undisturbed("1");
  const std::string report = text_of(desk_.home / "undisturbed/report.html");
  for (const char* jobs : {"2", "5"}) {
    EXPECT_TRUE(undisturbed(jobs) == expected) << jobs;
    EXPECT_TRUE(text_of(desk_.home / "undisturbed/report.html") == report) << jobs;
  }
}

TEST_F(Interrupted, ShardsMergedAreAsOneSweep) {
  const std::string expected = undisturbed();
  for (const char* shard : {"3/3", "1/3"}) {
    EXPECT_EQ(desk_.umbsim({"sweep", "tiny_sweep.yaml", "--out", "parts", "--shard", shard}).code, 0);
  }
  const Outcome early = desk_.umbsim({"sweep", "merge", "tiny_sweep.yaml", "--out", "parts"});
  EXPECT_EQ(early.code, 3);
  expect_says(early.err, {"of 400 points are missing"});
  // The last one is killed, and started again.
  {
    Running program(desk_, {"sweep", "tiny_sweep.yaml", "--out", "parts", "--shard", "2/3"});
    pause_s(0.1);
    program.signal(SIGKILL);
    program.wait();
  }
  EXPECT_EQ(desk_.umbsim({"sweep", "tiny_sweep.yaml", "--out", "parts", "--shard", "2/3"}).code, 0);
  EXPECT_EQ(desk_.umbsim({"sweep", "merge", "tiny_sweep.yaml", "--out", "parts"}).code, 0);
  EXPECT_TRUE(content_of(desk_.home / "parts/sweep.sqlite") == expected);
  EXPECT_TRUE(text_of(desk_.home / "parts/report.html") == text_of(desk_.home / "undisturbed/report.html"));
}

}  // namespace
}  // namespace umbsim::acceptance
