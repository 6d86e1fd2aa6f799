#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <cstdio>
#include <mutex>
#include <string>
#include <thread>

namespace umbsim {

/// How far a long batch is: on a terminal a bar with rate and time left; elsewhere (a log) a line a minute.
/// Thread-safe.
class ProgressLog {
 public:
  struct Options {
    std::FILE* stream = stderr;
    bool terminal = false;             ///< draw a bar
    std::chrono::milliseconds every{60000};
  };
  static Options on_standard_error();

  /// `done` of `total` are done already, by an earlier start or another process.
  ProgressLog(std::string what, std::int64_t done, std::int64_t total, Options options);
  ~ProgressLog();
  ProgressLog(const ProgressLog&) = delete;
  ProgressLog& operator=(const ProgressLog&) = delete;

  /// One more: `ours`: this process did it, so it counts for the rate.
  void step(bool ours = true);

 private:
  void watch(const std::stop_token& stop);
  std::string line() const;

  std::string what_;
  std::int64_t done_, total_, ours_ = 0;
  Options options_;
  std::chrono::steady_clock::time_point start_;
  mutable std::mutex mutex_;
  std::condition_variable_any woken_;
  std::jthread watcher_;  // last: it uses the others
};

/// "1 h 02 min", "3 min 20 s", "12 s".
std::string duration_text(double seconds);

}  // namespace umbsim
