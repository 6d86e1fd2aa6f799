#pragma once

#include <chrono>
#include <mutex>
#include <string>

namespace umbsim {

/// A progress bar on standard error: only on a terminal, and only for work that takes a while. Thread-safe.
class Progress {
 public:
  Progress(std::string what, int total);
  ~Progress();
  void step();
  /// So many are done.
  void reach(int done);

 private:
  void show();
  void draw(double elapsed_s);
  std::string what_;
  int total_;
  int done_ = 0;
  bool terminal_;
  bool drawn_ = false;
  std::chrono::steady_clock::time_point start_;
  double last_draw_s_ = 0;
  std::mutex mutex_;
};

}  // namespace umbsim
