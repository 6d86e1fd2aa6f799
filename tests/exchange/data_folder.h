#pragma once

#include <string>
#include <vector>

#include "tests/acceptance/program.h"

namespace umbsim::acceptance {

/// A file of tests/exchange/data.
inline std::string data(const std::string& name) {
  return std::string(UMBSIM_SOURCE_DIR) + "/tests/exchange/data/" + name;
}

using Words = std::vector<std::string>;

inline Words joined(Words a, const Words& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// What the robot of drive.py is believed to be.
inline const Words kRobot = {"--wheel-radius", "0.033", "--wheelbase", "0.16"};
inline const Words kTicks = {"--ticks-per-revolution", "4096"};

/// The squares of drive.py.
inline const Words kRuns = {"cw-1", "ccw-1", "cw-2", "ccw-2"};

/// Rows of numbers of a CSV file, without its header.
inline std::vector<std::vector<double>> numbers_of(const fs::path& file) {
  std::vector<std::vector<double>> rows;
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::istringstream cells(line);
    std::vector<double>& row = rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::stod(cell));
  }
  return rows;
}

/// Counts and commands of a simulated run come back from an export in `format`. `source`: what is imported of it.
inline void expect_commands_come_back(const std::string& format, const std::string& source) {
  constexpr double kPrinted = 1e-7;  // rad/s
  const Desk desk;
  desk.put("short.yaml", kShortScenario);
  ASSERT_EQ(desk.umbsim({"run", "short.yaml", "--set", "calibration.method=none", "--out", "sim"}).code, 0);
  ASSERT_EQ(desk.umbsim({"export", "sim", "--to", format, "--out", "out"}).code, 0);
  const Outcome outcome = desk.umbsim({"import", source, "--robot", "sim/labmate.urdf", "--ticks-per-revolution",
                                       "2000", "--runs", "out/runs.csv", "--keep-frame", "--out", "back"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  for (const std::string run : {"cw-1", "ccw-2"}) {
    const auto rows = numbers_of(desk.home / "sim/runs" / run / "encoders.csv");
    const auto again = numbers_of(desk.home / "back/runs" / run / "encoders.csv");
    ASSERT_EQ(rows.size(), again.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      ASSERT_EQ(again[i].size(), 5u);
      EXPECT_EQ(rows[i][1], again[i][1]);
      EXPECT_NEAR(rows[i][3], again[i][3], kPrinted);
      EXPECT_NEAR(rows[i][4], again[i][4], kPrinted);
    }
  }
}

}  // namespace umbsim::acceptance
