#include "exchange/bag/messages/array_length.h"

#include <fmt/format.h>

#include <charconv>

#include "core/error.h"

namespace umbsim::exchange {

std::size_t array_length(const std::string& text) {
  constexpr std::size_t kMost = 1'000'000'000;
  std::size_t length = 0;
  const char* end = text.data() + text.size();
  const auto [stopped, failure] = std::from_chars(text.data(), end, length);
  if (failure != std::errc() || stopped != end || length > kMost)
    throw InputError(
        fmt::format("a message definition has an array of '{}' elements, must be a whole number <= {}", text, kMost));
  return length;
}

}  // namespace umbsim::exchange
