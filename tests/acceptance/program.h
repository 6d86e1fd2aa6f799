#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace umbsim::acceptance {

namespace fs = std::filesystem;
using nlohmann::json;

// Exit codes (docs/outputs.md).
constexpr int kBadInput = 2, kRunFailed = 3;

inline std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

inline json json_of(const fs::path& file) { return json::parse(text_of(file)); }

inline std::string shell_quoted(const std::string& word) {
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + "'";
}

/// What a command left behind for the one who typed it.
struct Outcome {
  int code = -1;
  std::string out;
  std::string err;
};

/// A working folder of its own for one test, removed at the end. Commands run in `home`; what they print is kept
/// beside it, so that `home` holds nothing but what the program wrote.
class Desk {
 public:
  Desk() {
    std::string pattern = (fs::path(::testing::TempDir()) / "umbsim_XXXXXX").string();
    if (!mkdtemp(pattern.data())) throw std::runtime_error("no temporary folder: " + pattern);
    root_ = pattern;
    home = root_ / "home";
    fs::create_directory(home);
  }
  ~Desk() {
    std::error_code ignored;
    fs::remove_all(root_, ignored);
  }
  Desk(const Desk&) = delete;
  Desk& operator=(const Desk&) = delete;

  Outcome shell(const std::string& line) const {
    const std::string out = (root_ / "out").string(), err = (root_ / "err").string();
    const std::string command = "cd " + shell_quoted(home.string()) + " && { " + line + "\n} > " + shell_quoted(out) +
                                " 2> " + shell_quoted(err) + " < /dev/null";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), text_of(out), text_of(err)};
  }

  /// Runs the program with these words as its arguments.
  Outcome umbsim(const std::vector<std::string>& words) const {
    std::string line = shell_quoted(UMBSIM_PROGRAM);
    for (const std::string& word : words) line.append(" ").append(shell_quoted(word));
    return shell(line);
  }

  fs::path put(const std::string& name, const std::string& text) const {
    fs::create_directories((home / name).parent_path());
    std::ofstream(home / name, std::ios::binary) << text;
    return home / name;
  }

  fs::path home;

 private:
  fs::path root_;
};

inline std::string shipped(const std::string& scenario) {
  return std::string(UMBSIM_SOURCE_DIR) + "/scenarios/" + scenario + ".yaml";
}

/// A short drive, so that a test of files and messages does not wait for physics.
inline const char* kShortScenario = R"(format: umbsim-scenario/1
description: A short drive
seed: 7
robot: {urdf: labmate.urdf}
encoders: {ticks_per_revolution: 2000, rate_hz: 50}
course: {side_m: 0.5, linear_speed_mps: 0.5, angular_speed_radps: 1.5, linear_acceleration_mps2: 1, dwell_s: 0}
runs: {per_direction: 2}
noise: {floor_rms_m: 0.0005, radius_scatter: 0.0001}
truth: {position_sd_m: 0.002, heading_sd_rad: 0.007}
effects:
  wheelbase: {relative: -0.01}
)";

/// Every file below `folder` by its relative name, with its content.
inline std::map<std::string, std::string> files_of(const fs::path& folder) {
  std::map<std::string, std::string> files;
  if (!fs::exists(folder)) return files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) files[fs::relative(entry.path(), folder).string()] = text_of(entry.path());
  }
  return files;
}

inline std::set<std::string> names_of(const std::map<std::string, std::string>& files) {
  std::set<std::string> names;
  for (const auto& [name, text] : files) names.insert(name);
  return names;
}

/// Names in a folder, hidden ones too.
inline std::set<std::string> listing(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename().string());
  return names;
}

/// All parts of `message` that are expected, in any order.
inline void expect_says(const std::string& message, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) {
    EXPECT_NE(message.find(part), std::string::npos) << "'" << part << "' is missing in: " << message;
  }
}

/// What was wrapped for the terminal, in whole lines again.
inline std::string unwrapped(const std::string& text) { return std::regex_replace(text, std::regex("\n +"), " "); }

}  // namespace umbsim::acceptance
