#pragma once

#include <fcntl.h>
#include <spawn.h>
#include <unistd.h>

#include <csignal>

#include "batch/store/sqlite.h"
#include "tests/acceptance/program.h"

namespace umbsim::acceptance {

/// Drives of a few milliseconds each, calibrated and driven again, with noise.
inline const char* kTinyScenario = R"(format: umbsim-scenario/1
description: A tiny drive
seed: 7
encoders: {ticks_per_revolution: 2000, rate_hz: 50}
course: {side_m: 0.3, linear_speed_mps: 0.5, angular_speed_radps: 1.5, linear_acceleration_mps2: 1, dwell_s: 0}
runs: {per_direction: 1}
noise: {radius_scatter: 0.0001}
truth: {kind: endpoints, position_sd_m: 0.002, heading_sd_rad: 0.007}
calibration: {max_passes: 1}
)";

/// `count` wheelbases times two methods.
inline std::string tiny_sweep(int count, const std::string& more = "") {
  return "format: umbsim-sweep/1\nscenario: tiny.yaml\naxes:\n"
         "  effects.wheelbase.relative: {from: -0.02, to: 0.02, count: " + std::to_string(count) + "}\n"
         "  calibration.method: [endpoint, heading]\n" + more;
}

/// All rows of all tables, but for the history of starts.
inline std::string content_of(const fs::path& database_file) {
  Database database(database_file, Database::Mode::read);
  std::string text;
  std::vector<std::string> tables;
  {
    Statement names = database.prepare("SELECT name FROM sqlite_schema WHERE type = 'table' ORDER BY name");
    while (names.step()) tables.push_back(names.text(0));
  }
  for (const std::string& table : tables) {
    if (table == "starts") continue;
    text += "== " + table + "\n";
    Statement rows =
        database.prepare("SELECT * FROM " + table + (table == "runs" ? " ORDER BY 1, 4, 2" : " ORDER BY 1"));
    while (rows.step()) {
      for (int i = 0; i < rows.columns(); ++i) text += text_of_cell(rows.cell(i)) + "|";
      text += "\n";
    }
  }
  return text;
}

inline std::int64_t points_in(const fs::path& database_file) {
  Database database(database_file, Database::Mode::read);
  return std::get<std::int64_t>(database.value("SELECT count(*) FROM points"));
}

/// The program in the background.
class Running {
 public:
  Running(const Desk& desk, std::vector<std::string> words) {
    words.insert(words.begin(), UMBSIM_PROGRAM);
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addchdir_np(&actions, desk.home.c_str());
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    if (posix_spawn(&child_, argv[0], &actions, nullptr, argv.data(), environ) != 0) {
      throw std::runtime_error("cannot start " + words[0]);
    }
    posix_spawn_file_actions_destroy(&actions);
  }
  ~Running() {
    if (child_ > 0) signal(SIGKILL), wait();
  }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

  void signal(int number) const { kill(child_, number); }
  /// The exit code, or 128 and the signal that ended it.
  int wait() {
    int status = 0;
    waitpid(child_, &status, 0);
    child_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

 private:
  pid_t child_ = -1;
};

}  // namespace umbsim::acceptance
