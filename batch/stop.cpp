#include "batch/stop.h"

#include <csignal>

namespace umbsim {
namespace {

volatile std::sig_atomic_t received_signal = 0;

void note(int signal) {
  if (received_signal != 0) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
  received_signal = signal;
}

// Without SA_RESTART: a wait for another process is cut short, too.
void (*install(int signal, void (*handler)(int)))(int) {
  struct sigaction action {};
  struct sigaction old {};
  action.sa_handler = handler;
  sigaction(signal, &action, &old);
  return old.sa_handler;
}

}  // namespace

StopRequests::StopRequests() {
  received_signal = 0;
  old_interrupt_ = install(SIGINT, note);
  old_terminate_ = install(SIGTERM, note);
}

StopRequests::~StopRequests() {
  install(SIGINT, old_interrupt_);
  install(SIGTERM, old_terminate_);
  received_signal = 0;
}

int StopRequests::received() { return received_signal; }

}  // namespace umbsim
