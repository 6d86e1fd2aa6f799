#pragma once

#include <cstdint>
#include <filesystem>

namespace umbsim {

/// Which process works on which case of a batch: byte k of a lock file is locked while case k is in work. The kernel
/// gives the lock back when the process ends, however it ends. On a file system without locks every claim is granted;
/// then two processes may do a case twice, and the store keeps one.
class Claims {
 public:
  /// Throws RunError if the file cannot be made.
  explicit Claims(const std::filesystem::path& file);
  ~Claims();
  Claims(const Claims&) = delete;
  Claims& operator=(const Claims&) = delete;

  /// False: another process has it.
  bool take(std::int64_t number);
  void release(std::int64_t number);
  /// Waits until nobody has it; a signal ends the wait.
  void wait_for(std::int64_t number);

 private:
  int descriptor_;
};

}  // namespace umbsim
