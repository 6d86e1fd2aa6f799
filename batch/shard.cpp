#include "batch/shard.h"

#include <charconv>

#include <fmt/format.h>

#include "core/error.h"

namespace umbsim {
namespace {

constexpr std::int64_t kMaxShards = 1000000;

bool whole_number(const char* begin, const char* end, std::int64_t& value) {
  const auto [stop, error] = std::from_chars(begin, end, value);
  return error == std::errc() && stop == end;
}

}  // namespace

Shard parse_shard(const std::string& text) {
  const std::size_t slash = text.find('/');
  std::int64_t i = 0, n = 0;
  const char* begin = text.data();
  if (slash == std::string::npos || !whole_number(begin, begin + slash, i) ||
      !whole_number(begin + slash + 1, begin + text.size(), n)) {
    throw InputError(fmt::format("--shard {}: must have the form i/n, as in 2/4", text));
  }
  if (n < 1 || n > kMaxShards) {
    throw InputError(fmt::format("--shard {}: n = {} is out of range (must be >= 1 and <= {})", text, n, kMaxShards));
  }
  if (i < 1 || i > n) {
    throw InputError(fmt::format("--shard {}: i = {} is out of range (must be >= 1 and <= {})", text, i, n));
  }
  return {i - 1, n};
}

}  // namespace umbsim
