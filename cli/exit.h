#pragma once

#include <stdexcept>

namespace umbsim {

/// The work is done, and the program ends with another code than 0. Caught in main; the message may be empty.
class Exit : public std::runtime_error {
 public:
  Exit(int exit_code, const std::string& message) : std::runtime_error(message), code(exit_code) {}
  int code;
};

constexpr int kUnmet = 1;
constexpr int kBadInput = 2;
constexpr int kRunFailed = 3;
constexpr int kSignalled = 128;  ///< plus the signal's number, as shells do

}  // namespace umbsim
