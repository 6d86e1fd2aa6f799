// Commands of the body (cmd_vel), and bags that were packed after they were recorded.
#include <cmath>

#include "tests/exchange/data_folder.h"

namespace umbsim::acceptance {
namespace {

Outcome import_whole(const Desk& desk, const Words& words, const std::string& out = "out") {
  return desk.umbsim(joined(joined({"import"}, words), joined(kRobot, {"--cut", "none", "--out", out})));
}

/// Wheel speeds that drive.py commanded, in rad/s: of the text log, row by row from the log's first on.
std::vector<std::array<double, 2>> commanded() {
  std::vector<std::array<double, 2>> rows;
  std::ifstream in(data("echo_joint_states.csv"));
  for (std::string line; std::getline(in, line);) {
    std::vector<std::string> cells;
    std::istringstream parts(line);
    for (std::string cell; std::getline(parts, cell, ',');) cells.push_back(cell);
    rows.push_back({std::stod(cells.at(7)), std::stod(cells.at(8))});
  }
  return rows;
}

constexpr double kPrinted = 1e-6;  // rad/s
constexpr std::size_t kLate = 1;   // row of the wheels before the tracker's first pose, which is no part of the run

TEST(Commands, TwistsBecomeWheelSpeeds) {
  const Desk desk;
  const Outcome outcome = import_whole(desk, {data("commands.mcap")});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  expect_says(unwrapped(outcome.out), {"commands: 300 messages of /cmd_vel", "wheelbase as believed"});
  const auto rows = numbers_of(desk.home / "out/runs/run-1/encoders.csv");
  const auto wanted = commanded();
  ASSERT_EQ(rows.size(), 300 - kLate);
  double moved = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    ASSERT_EQ(rows[i].size(), 5u);
    EXPECT_NEAR(rows[i][3], wanted[i + kLate][0], kPrinted) << i;
    EXPECT_NEAR(rows[i][4], wanted[i + kLate][1], kPrinted) << i;
    moved = std::max(moved, std::abs(rows[i][3] - rows[i][4]));
  }
  EXPECT_GT(moved, 1);  // it turned
}

TEST(Commands, EndWhereNoneFollowsAndAreSaid) {
  const Desk desk;
  const Outcome outcome = import_whole(desk, {data("commands_stamped.mcap")});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  expect_says(unwrapped(outcome.out),
              {"285 messages of /diff_drive_controller/cmd_vel", "2 that none followed within 0.5 s"});
  const auto rows = numbers_of(desk.home / "out/runs/run-1/encoders.csv");
  const auto wanted = commanded();
  // Rows 70 to 84 had none: the command of row 69 holds for ten rows of 50 ms. The log ends at a command, too.
  const auto left = [&](std::size_t row) { return rows[row - kLate][3]; };
  EXPECT_NEAR(left(78), wanted[69][0], kPrinted);
  EXPECT_GT(left(78), 1);
  EXPECT_EQ(left(80), 0);
  EXPECT_EQ(left(84), 0);
  EXPECT_NEAR(left(85), wanted[85][0], kPrinted);
}

TEST(Commands, MayBeChosenOrLeftOut) {
  const Desk desk;
  ASSERT_EQ(import_whole(desk, {data("commands.mcap"), "--commands", "none"}).code, 0);
  EXPECT_EQ(numbers_of(desk.home / "out/runs/run-1/encoders.csv").at(0).size(), 3u);
  const auto refused = [&](const Words& words, const Words& says) {
    const Outcome outcome = import_whole(desk, words, "refused");
    EXPECT_EQ(outcome.code, 2) << outcome.out;
    expect_says(outcome.err, says);
    EXPECT_FALSE(fs::exists(desk.home / "refused"));
  };
  refused({data("commands.mcap"), "--commands", "/cmd_vel_nav"}, {"--commands none", "run-1"});
  refused({data("commands.mcap"), "--commands", "/mocap/pose"}, {"holds no speeds", "geometry_msgs/Twist"});
  refused({data("commands.mcap"), "--commands", "/nothing"}, {"there is no such topic", "/cmd_vel"});
}

TEST(Packed, BagsThatZstdPackedAreRead) {
  const Desk desk;
  ASSERT_EQ(import_whole(desk, {data("commands.mcap"), "--commands", "none"}, "plain").code, 0);
  ASSERT_EQ(import_whole(desk, {data("spoiled/good.mcap")}, "good").code, 0);
  for (const auto& [name, same] :
       {std::pair{"packed_by_file", "plain"}, std::pair{"packed_by_file/by_file_0.db3.zstd", "plain"},
        std::pair{"packed_by_message", "plain"}, std::pair{"packed.mcap.zst", "good"}}) {
    SCOPED_TRACE(name);
    const std::string out = "out-" + fs::path(name).filename().string();
    const Outcome outcome = import_whole(desk, {data(name)}, out);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    for (const char* file : {"encoders.csv", "truth.csv"}) {
      EXPECT_EQ(text_of(desk.home / out / "runs/run-1" / file), text_of(desk.home / same / "runs/run-1" / file));
    }
  }
}

TEST(Packed, DamagedOnesAreNamed) {
  const std::string whole = text_of(data("packed_by_file/by_file_0.db3.zstd"));
  for (const std::size_t size : {whole.size() / 2, std::size_t(6), whole.size() - 1}) {
    const Desk desk;
    desk.put("bag.db3.zstd", whole.substr(0, size));
    const Outcome outcome = import_whole(desk, {"bag.db3.zstd"});
    EXPECT_EQ(outcome.code, 2) << outcome.out;
    expect_says(outcome.err, {"bag.db3.zstd", "cut off"});
    EXPECT_EQ(listing(desk.home), std::set<std::string>{"bag.db3.zstd"});
  }
}

// Of a simulated run: what was commanded comes back by way of the body's speeds.
TEST(Commands, ComeBackFromMcap) { expect_commands_come_back("mcap", "out"); }

}  // namespace
}  // namespace umbsim::acceptance
