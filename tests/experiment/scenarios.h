#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "experiment/scenario/scenario.h"

namespace umbsim::testing {

inline std::string shipped_file(const std::string& name) {
  return std::string(UMBSIM_SOURCE_DIR) + "/scenarios/" + name + ".yaml";
}

inline Scenario shipped(const std::string& name, const std::vector<std::string>& settings = {}) {
  return read_scenario(shipped_file(name), settings);
}

/// A folder of this test's own, gone at its end.
class TemporaryFolder {
 public:
  TemporaryFolder()
      : path_(std::filesystem::path(::testing::TempDir()) /
              ("umbsim_" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()) + "_" +
               std::to_string(getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name) << text;
    return (path_ / name).string();
  }

 private:
  std::filesystem::path path_;
};

}  // namespace umbsim::testing
