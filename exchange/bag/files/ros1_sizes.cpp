#include "exchange/bag/files/ros1_sizes.h"

#include <fmt/format.h>

#include <cstring>
#include <optional>
#include <set>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "exchange/bag/files/mapped_file.h"
#include "exchange/bag/files/mcap_records.h"

namespace umbsim::exchange {
namespace {

using mcap::Fields;

constexpr std::size_t kMagicBytes = 13;  // "#ROSBAG V2.0\n"

enum Op : std::uint8_t { kBagHeader = 3, kIndexData = 4, kChunk = 5, kChunkInfo = 6, kConnection = 7 };

struct Record {
  std::string_view header, data;

  /// The value of a field as a number.
  template <class T>
  std::optional<T> field(std::string_view name) const {
    Fields fields(reinterpret_cast<const std::uint8_t*>(header.data()), header.size());
    while (fields.left() > 0) {
      const auto size = fields.number<std::uint32_t>();
      const std::string_view field(reinterpret_cast<const char*>(fields.take(size)), size);
      if (field.size() != name.size() + 1 + sizeof(T) || !field.starts_with(name) || field[name.size()] != '=')
        continue;
      T value;
      std::memcpy(&value, field.data() + name.size() + 1, sizeof(T));
      return value;
    }
    return std::nullopt;
  }
  template <class T>
  T needed(std::string_view name) const {
    const std::optional<T> value = field<T>(name);
    if (!value) throw InputError(fmt::format("a record has no {}", name));
    return *value;
  }
};

std::string_view next_bytes(Fields& fields) {
  const auto size = fields.number<std::uint32_t>();
  return {reinterpret_cast<const char*>(fields.take(size)), size};
}

// What rosbag parses as a header: its fields, each "name=value", fill it.
void check_header(std::string_view header) {
  Fields fields(reinterpret_cast<const std::uint8_t*>(header.data()), header.size());
  while (fields.left() > 0) {
    if (next_bytes(fields).find('=') == std::string_view::npos) throw InputError("a field of a record has no '='");
  }
}

// A chunk's messages by their index: offsets into what it unpacks to.
void check_index(const Record& index, std::uint32_t chunk_size) {
  Fields entries(reinterpret_cast<const std::uint8_t*>(index.data.data()), index.data.size());
  for (auto count = index.needed<std::uint32_t>("count"); count > 0; --count) {
    entries.number<std::uint64_t>();  // time of receipt
    if (entries.number<std::uint32_t>() >= chunk_size) throw InputError("an index points beyond its chunk");
  }
}

void check_chunk(const Record& chunk) {
  constexpr std::uint64_t kClosest = 1 << 21;  // bzip2 packs zeros a million times
  const auto size = chunk.needed<std::uint32_t>("size");
  if (size > kClosest * chunk.data.size())
    throw InputError(fmt::format("{} bytes cannot hold a chunk of {}", chunk.data.size(), size));
}

void check(const MappedFile& file) {
  if (file.size() <= kMagicBytes || std::memcmp(file.data(), "#ROSBAG V2.0\n", kMagicBytes) != 0) return;
  Fields fields(file.data() + kMagicBytes, file.size() - kMagicBytes);
  std::set<std::uint64_t> places, pointed_at;
  std::uint32_t chunk_size = 0;
  while (fields.left() > 0) {
    places.insert(std::uint64_t(fields.here() - file.data()));
    const Record record{next_bytes(fields), next_bytes(fields)};
    check_header(record.header);
    switch (record.needed<std::uint8_t>("op")) {
      case kBagHeader:
        if (record.needed<std::uint64_t>("index_pos") == 0) return;
        pointed_at.insert(record.needed<std::uint64_t>("index_pos"));
        break;
      case kChunk:
        check_chunk(record);
        chunk_size = record.needed<std::uint32_t>("size");
        break;
      case kIndexData:
        check_index(record, chunk_size);
        break;
      case kConnection:
        check_header(record.data);
        break;
      case kChunkInfo:
        pointed_at.insert(record.needed<std::uint64_t>("chunk_pos"));
        break;
      default:
        break;
    }
  }
  for (const std::uint64_t at : pointed_at) {
    if (places.count(at) == 0) throw InputError(fmt::format("no record begins at byte {}", at));
  }
}

}  // namespace

void check_ros1_sizes(const std::string& path, const std::string& name) {
  try {
    check(MappedFile(path));
  } catch (const std::out_of_range&) {
    throw InputError(SourceMark{name}, "is no whole ROS 1 bag: a record claims more bytes than there are");
  } catch (const InputError& e) {
    throw InputError(SourceMark{name}, fmt::format("is no whole ROS 1 bag: {}", e.what()));
  }
}

}  // namespace umbsim::exchange
