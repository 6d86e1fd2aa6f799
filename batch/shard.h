#pragma once

#include <cstdint>
#include <string>

namespace umbsim {

/// One of `count` equal parts of a batch: the cases index, index + count, index + 2 count, ... (from 0).
struct Shard {
  std::int64_t index = 0;
  std::int64_t count = 1;
  bool has(std::int64_t number) const { return number % count == index; }
  bool whole() const { return count == 1; }
};

/// "2/4": the second of four, as people count. Throws InputError.
Shard parse_shard(const std::string& text);

}  // namespace umbsim
