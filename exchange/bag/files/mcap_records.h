#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace umbsim::exchange::mcap {

/// The parts of https://mcap.dev/spec that are read and written here.
constexpr std::string_view kMagic("\x89MCAP0\r\n", 8);

enum Opcode : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kStatistics = 0x0B,
  kDataEnd = 0x0F,
};

/// Bytes from which fields are taken one after the other. Throws std::out_of_range at the end.
class Fields {
 public:
  Fields(const std::uint8_t* data, std::size_t size) : at_(data), left_(size) {}

  template <class T>
  T number() {
    T value;
    std::memcpy(&value, take(sizeof(T)), sizeof(T));
    return value;
  }
  std::string text() {
    const auto size = number<std::uint32_t>();
    return {reinterpret_cast<const char*>(take(size)), size};
  }
  const std::uint8_t* take(std::size_t size);
  std::size_t left() const { return left_; }
  const std::uint8_t* here() const { return at_; }

 private:
  const std::uint8_t* at_;
  std::size_t left_;
};

/// The content of a chunk. `compression`: "", lz4 or zstd. Throws InputError with what is wrong.
std::vector<std::uint8_t> unpacked(const std::string& compression, const std::uint8_t* data, std::size_t size,
                                   std::uint64_t unpacked_size, std::uint32_t crc32);

std::uint32_t crc32_of(const void* data, std::size_t size);

}  // namespace umbsim::exchange::mcap
