#pragma once

namespace umbsim {

/// While it lives, the first SIGINT (Ctrl-C) or SIGTERM asks for an orderly end instead of ending the program; the
/// second ends it at once. One at a time.
class StopRequests {
 public:
  StopRequests();
  ~StopRequests();
  StopRequests(const StopRequests&) = delete;
  StopRequests& operator=(const StopRequests&) = delete;

  /// The signal that came; 0: none.
  static int received();

 private:
  void (*old_interrupt_)(int);
  void (*old_terminate_)(int);
};

}  // namespace umbsim
