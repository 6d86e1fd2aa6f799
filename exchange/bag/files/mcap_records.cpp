#include "exchange/bag/files/mcap_records.h"

#include <fmt/format.h>
#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>
#include <boost/crc.hpp>
#include <stdexcept>

#include "core/error.h"

namespace umbsim::exchange::mcap {
namespace {

constexpr std::uint64_t kLargestChunk = std::uint64_t(1) << 31;

void unpack_lz4(const std::uint8_t* data, std::size_t size, std::vector<std::uint8_t>& out) {
  LZ4F_dctx* context = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&context, LZ4F_VERSION))) throw InputError("no memory for LZ4");
  std::size_t in_at = 0, out_at = 0, result = 1;
  while (result != 0 && in_at < size) {
    std::size_t in_size = size - in_at, out_size = out.size() - out_at;
    result = LZ4F_decompress(context, out.data() + out_at, &out_size, data + in_at, &in_size, nullptr);
    if (LZ4F_isError(result) || (in_size == 0 && out_size == 0)) break;
    in_at += in_size;
    out_at += out_size;
  }
  LZ4F_freeDecompressionContext(context);
  if (result != 0 || out_at != out.size()) throw InputError("a chunk is damaged: LZ4 cannot unpack it");
}

}  // namespace

const std::uint8_t* Fields::take(std::size_t size) {
  if (size > left_) throw std::out_of_range("record");
  const std::uint8_t* here = at_;
  at_ += size;
  left_ -= size;
  return here;
}

std::uint32_t crc32_of(const void* data, std::size_t size) {
  boost::crc_32_type crc;
  crc.process_bytes(data, size);
  return crc.checksum();
}

std::vector<std::uint8_t> unpacked(const std::string& compression, const std::uint8_t* data, std::size_t size,
                                   std::uint64_t unpacked_size, std::uint32_t crc32) {
  if (unpacked_size > kLargestChunk) throw InputError(fmt::format("a chunk of {} bytes is damaged", unpacked_size));
  // Neither packs closer than this; a size beyond is not worth its memory.
  constexpr std::uint64_t kClosest = 1 << 16, kSmall = 1 << 16;
  if (unpacked_size > kSmall + kClosest * std::uint64_t(size)) {
    throw InputError(fmt::format("a chunk is damaged: {} bytes cannot hold {}", size, unpacked_size));
  }
  std::vector<std::uint8_t> out(unpacked_size);
  if (compression.empty()) {
    if (size != unpacked_size) throw InputError("a chunk is damaged: its sizes differ");
    std::copy_n(data, size, out.begin());
  } else if (compression == "zstd") {
    const std::size_t result = ZSTD_decompress(out.data(), out.size(), data, size);
    if (ZSTD_isError(result) || result != out.size()) throw InputError("a chunk is damaged: zstd cannot unpack it");
  } else if (compression == "lz4") {
    unpack_lz4(data, size, out);
  } else {
    throw InputError(fmt::format("compression '{}' is not known (must be zstd, lz4 or none)", compression));
  }
  if (crc32 != 0 && crc32_of(out.data(), out.size()) != crc32) {
    throw InputError("a chunk is damaged: its checksum does not fit");
  }
  return out;
}

}  // namespace umbsim::exchange::mcap
