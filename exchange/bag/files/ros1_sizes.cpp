#include "exchange/bag/files/ros1_sizes.h"

#include <bzlib.h>
#include <fmt/format.h>
#include <roslz4/lz4s.h>

#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>

#include "core/error.h"
#include "exchange/bag/files/mapped_file.h"
#include "exchange/bag/files/mcap_records.h"

namespace umbsim::exchange {
namespace {

using mcap::Fields;

constexpr std::string_view kMagic = "#ROSBAG V2.0\n";

enum Op : std::uint8_t { kBagHeader = 3, kIndexData = 4, kChunk = 5, kChunkInfo = 6, kConnection = 7 };

Fields fields_of(std::string_view bytes) { return {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}; }

std::string_view next_bytes(Fields& fields) {
  const auto size = fields.number<std::uint32_t>();
  return {reinterpret_cast<const char*>(fields.take(size)), size};
}

struct Record {
  std::string_view header, data;

  /// The value of a field; none where the record has no such field.
  std::optional<std::string_view> field(std::string_view name) const {
    Fields fields = fields_of(header);
    while (fields.left() > 0) {
      const std::string_view field = next_bytes(fields);
      if (field.size() > name.size() && field.starts_with(name) && field[name.size()] == '=')
        return field.substr(name.size() + 1);
    }
    return std::nullopt;
  }
  template <class T>
  T number(std::string_view name) const {
    const std::optional<std::string_view> value = field(name);
    if (!value || value->size() != sizeof(T)) throw InputError(fmt::format("a record has no {}", name));
    return fields_of(*value).number<T>();
  }
};

// What rosbag parses as a header: its fields, each "name=value", fill it.
void check_header(std::string_view header) {
  Fields fields = fields_of(header);
  while (fields.left() > 0) {
    if (next_bytes(fields).find('=') == std::string_view::npos) throw InputError("a field of a record has no '='");
  }
}

Record next_record(Fields& fields) {
  const Record record{next_bytes(fields), next_bytes(fields)};
  check_header(record.header);
  return record;
}

// A chunk's bytes, by the libraries that rosbag itself unpacks them with.
std::string unpacked(const Record& chunk) {
  constexpr std::uint64_t kClosest = 1 << 21;  // bzip2 packs zeros a million times
  const auto size = chunk.number<std::uint32_t>("size");
  if (size > kClosest * chunk.data.size())
    throw InputError(fmt::format("{} bytes cannot hold a chunk of {}", chunk.data.size(), size));
  const std::string_view compression = chunk.field("compression").value_or("none");
  if (compression == "none") return std::string(chunk.data);
  std::string out(size, '\0');
  unsigned out_size = size;
  char* const packed = const_cast<char*>(chunk.data.data());  // both read it only
  const bool whole =
      compression == "bz2"
          ? BZ2_bzBuffToBuffDecompress(out.data(), &out_size, packed, unsigned(chunk.data.size()), 0, 0) == BZ_OK
          : compression == "lz4" &&
                roslz4_buffToBuffDecompress(packed, unsigned(chunk.data.size()), out.data(), &out_size) == ROSLZ4_OK;
  if (!whole || out_size != size) throw InputError(fmt::format("a chunk cannot be unpacked as {}", compression));
  return out;
}

// Where the records of a chunk begin, in what it unpacks to.
std::set<std::uint32_t> places_in(const Record& chunk) {
  const std::string bytes = unpacked(chunk);
  Fields fields = fields_of(bytes);
  std::set<std::uint32_t> places;
  while (fields.left() > 0) {
    places.insert(std::uint32_t(bytes.size() - fields.left()));
    if (const Record record = next_record(fields); record.number<std::uint8_t>("op") == kConnection)
      check_header(record.data);
  }
  return places;
}

// The messages of a chunk by their index.
void check_index(const Record& index, const std::set<std::uint32_t>& places) {
  Fields entries = fields_of(index.data);
  for (auto count = index.number<std::uint32_t>("count"); count > 0; --count) {
    entries.number<std::uint64_t>();  // time of receipt
    if (places.count(entries.number<std::uint32_t>()) == 0)
      throw InputError("an index points to no record of its chunk");
  }
}

void check(const MappedFile& file) {
  const std::string_view bytes(reinterpret_cast<const char*>(file.data()), file.size());
  if (!bytes.starts_with(kMagic))
    throw InputError("its first line is not #ROSBAG V2.0 (`rosbag fix` makes older ones so)");
  Fields fields = fields_of(bytes.substr(kMagic.size()));
  std::set<std::uint64_t> places, pointed_at;
  std::set<std::uint32_t> in_chunk;
  while (fields.left() > 0) {
    places.insert(std::uint64_t(fields.here() - file.data()));
    const Record record = next_record(fields);
    switch (record.number<std::uint8_t>("op")) {
      case kBagHeader:
        if (record.number<std::uint64_t>("index_pos") == 0) return;
        pointed_at.insert(record.number<std::uint64_t>("index_pos"));
        break;
      case kChunk:
        in_chunk = places_in(record);
        break;
      case kIndexData:
        check_index(record, in_chunk);
        break;
      case kConnection:
        check_header(record.data);
        break;
      case kChunkInfo:
        pointed_at.insert(record.number<std::uint64_t>("chunk_pos"));
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
