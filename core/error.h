#pragma once

#include <stdexcept>
#include <string>

namespace umbsim {

/// Where in a text file something stands. Lines and columns count from 1; 0 means unknown.
struct SourceMark {
  std::string file;
  int line = 0;
  int column = 0;
};

/// Input that the program cannot accept. The message names file, line, key, value and the violated bound.
/// Caught once, in main: exit code 2.
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& message) : std::runtime_error(message) {}
  InputError(const SourceMark& mark, const std::string& message)
      : std::runtime_error(prefix(mark) + message) {}

 private:
  static std::string prefix(const SourceMark& mark) {
    std::string text = mark.file;
    if (mark.line > 0) text.append(1, ':').append(std::to_string(mark.line));
    if (mark.line > 0 && mark.column > 0) text.append(1, ':').append(std::to_string(mark.column));
    if (!text.empty()) text.append(": ");
    return text;
  }
};

/// A run that failed although its input was accepted: non-finite state, disk full. Exit code 3.
class RunError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace umbsim
