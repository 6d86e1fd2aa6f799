#pragma once

#include <string>

namespace umbsim {

/// The shipped robots/, or what UMBSIM_ROBOTS says.
std::string robots_directory();

}  // namespace umbsim
