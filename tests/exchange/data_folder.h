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

}  // namespace umbsim::acceptance
