// `kill -9` at any moment: what was finished stays, nothing half written stands in the place of a result, and the next
// start says what it found and does its work.
#include <chrono>
#include <random>
#include <thread>

#include "tests/acceptance/sweep_program.h"

namespace umbsim::acceptance {
namespace {

constexpr int kKillsOfRuns = 12;

struct Command {
  const char* name;
  std::vector<std::string> words;
  const char* last_file;  ///< of its result
};

class Killed : public testing::Test {
 protected:
  Killed() {
    std::string text = kShortScenario;
    desk_.put("short.yaml", text.replace(text.find("per_direction: 2"), 16, "per_direction: 6"));
  }

  // Kills the command at random moments of what it takes, with and without a result to be replaced.
  void kill_at_random(const Command& command) {
    SCOPED_TRACE(command.name);
    const auto begin = std::chrono::steady_clock::now();
    ASSERT_EQ(desk_.umbsim(command.words).code, 0);
    const double whole_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    const std::set<std::string> whole = names_of(files_of(desk_.home / "out"));
    std::vector<std::string> again = command.words;
    again.push_back("--force");
    const unsigned seed = std::random_device{}();
    SCOPED_TRACE("moments from seed " + std::to_string(seed));
    std::mt19937 random(seed);
    for (int i = 0; i < kKillsOfRuns; ++i) {
      {
        Running program(desk_, again);
        std::this_thread::sleep_for(
            std::chrono::duration<double>(std::uniform_real_distribution<>(0, 1.1 * whole_s)(random)));
        program.signal(SIGKILL);
        program.wait();
      }
      // The result of before or the new one, never less.
      EXPECT_EQ(names_of(files_of(desk_.home / "out")), whole);
      EXPECT_FALSE(text_of(desk_.home / "out" / command.last_file).empty());
    }
    bool left = false;
    for (const std::string& name : listing(desk_.home)) left = left || name.ends_with(".part");
    const Outcome next = desk_.umbsim(again);
    EXPECT_EQ(next.code, 0) << next.err;
    if (left) {
      expect_says(next.err, {"a killed process had begun a result here"});
    }
    EXPECT_EQ(listing(desk_.home), (std::set<std::string>{"out", "short.yaml", "truth"})) << "something is left";
    fs::remove_all(desk_.home / "out");
  }

  Desk desk_;
};

TEST_F(Killed, RunCalibrateAndImport) {
  ASSERT_EQ(desk_.umbsim({"run", "short.yaml", "--out", "truth"}).code, 0);
  const std::string data = std::string(UMBSIM_SOURCE_DIR) + "/tests/exchange/data/";
  kill_at_random({"run", {"run", "short.yaml", "--out", "out"}, "report.html"});
  kill_at_random({"calibrate", {"calibrate", "truth", "--method", "heading", "--out", "out"}, "calibration.json"});
  kill_at_random({"import",
                  {"import", data + "drive_zstd.mcap", "--robot", data + "robot.urdf", "--out", "out"},
                  "recording.yaml"});
}

}  // namespace
}  // namespace umbsim::acceptance
