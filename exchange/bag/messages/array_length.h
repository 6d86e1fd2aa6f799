#pragma once

#include <cstddef>
#include <string>

namespace umbsim::exchange {

/// Length of an array in a message definition. Throws InputError if the text is no whole number, or beyond 1e9.
std::size_t array_length(const std::string& text);

}  // namespace umbsim::exchange
