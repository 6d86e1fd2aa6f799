#include "core/terminal.h"

#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <string_view>

namespace umbsim {
namespace {

std::atomic<bool> hidden{false};

std::string_view variable(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

}  // namespace

bool shows_progress() { return !hidden && isatty(STDERR_FILENO) != 0; }

void hide_progress() { hidden = true; }

bool shows_colour(int file_descriptor) {
  return isatty(file_descriptor) != 0 && variable("NO_COLOR").empty() && variable("TERM") != "dumb";
}

}  // namespace umbsim
