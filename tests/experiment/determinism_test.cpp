// The same bytes for any number of threads, and when repeated.
#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>

#include "experiment/output/result_json.h"
#include "experiment/run.h"
#include "tests/experiment/scenarios.h"

namespace umbsim {
namespace {

using testing::shipped;
using testing::TemporaryFolder;
namespace fs = std::filesystem;

// FNV-1a, 64 bits.
std::uint64_t hash(const std::string& bytes) {
  std::uint64_t h = 0xcbf29ce484222325ull;
  for (const unsigned char c : bytes) h = (h ^ c) * 0x100000001b3ull;
  return h;
}

// Noise of every kind, cables, calibration and two passes, on a small square.
Scenario small_noisy(const std::vector<std::string>& more = {}) {
  std::vector<std::string> settings{"course.side_m=0.6", "runs.per_direction=2", "bumps={count: 1}",
                                    "noise.radius_scatter=0.0001"};
  settings.insert(settings.end(), more.begin(), more.end());
  return shipped("umbmark", settings);
}

// Every file of the recordings that the experiment leaves behind, by name, and the measured figures.
std::map<std::string, std::uint64_t> traces(const Scenario& scenario, int jobs) {
  const TemporaryFolder folder;
  const ExperimentResult r = run_experiment(scenario, jobs);
  std::map<std::string, std::uint64_t> hashes;
  const auto add = [&](const Recording& recording, const std::string& name) {
    fs::create_directories(folder.path() / name);
    write_recording(recording, folder.path() / name);
  };
  add(r.recording, "plain");
  for (std::size_t i = 0; i < r.passes.size(); ++i) add(r.passes[i].recording, "pass" + std::to_string(i));
  for (const auto& entry : fs::recursive_directory_iterator(folder.path())) {
    if (!entry.is_regular_file()) continue;
    std::ifstream in(entry.path(), std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(in)), {});
    EXPECT_FALSE(bytes.empty());
    hashes[fs::relative(entry.path(), folder.path()).string()] = hash(bytes);
  }
  hashes["figures"] = hash(umbmark_json(*r.umbmark).dump());
  return hashes;
}

TEST(Determinism, SameBytesForAnyNumberOfThreads) {
  const auto reference = traces(small_noisy(), 1);
  EXPECT_GE(reference.size(), 2u * 4 + 4 + 1 + 1) << "two plain and two bumped runs each way, and the passes";
  for (const int jobs : {1, 2, 7}) {
    const auto again = traces(small_noisy(), jobs);
    EXPECT_EQ(again, reference) << jobs << " threads";
  }
  std::cout << reference.size() << " files the same for 1, 2 and 7 threads, and repeated\n";
}

TEST(Determinism, AnotherSeedIsAnotherExperiment) {
  const auto one = traces(small_noisy(), 0), other = traces(small_noisy({"seed=2"}), 0);
  for (const auto& [file, value] : one) {
    if (file.find("truth.csv") == std::string::npos || !other.count(file)) continue;
    EXPECT_NE(value, other.at(file)) << file;
  }
}

// Each run has random streams of its own. (Ticks may well agree: the motors follow the odometry's commands, and what
// differs is where that leads.)
TEST(Determinism, EveryRunOfADirectionDiffers) {
  const auto files = traces(small_noisy(), 0);
  for (const std::string name : {"plain/runs/cw-", "plain/runs/ccw-", "plain/runs/cw-bumped-", "pass0/runs/cw-"}) {
    EXPECT_NE(files.at(name + "1/truth.csv"), files.at(name + "2/truth.csv"));
  }
  EXPECT_NE(files.at("plain/runs/cw-1/truth.csv"), files.at("pass0/runs/cw-1/truth.csv"));
}

}  // namespace
}  // namespace umbsim
