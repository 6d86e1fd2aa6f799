#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "exchange/import/log.h"

namespace umbsim::exchange::mcap {

/// Writes an MCAP file as https://mcap.dev/spec describes it, into memory: zstd chunks with checksums, message and
/// chunk indexes, statistics and a summary, so that players seek in it.
class Writer {
 public:
  Writer(std::string_view profile, std::string_view library);

  /// A schema (encoding ros2msg) and a channel of CDR messages; returns the channel's id.
  std::uint16_t add_topic(const std::string& topic, const std::string& type, const std::string& definition);
  /// Times must not decrease.
  void add(std::uint16_t channel, Nanoseconds at, std::string_view data);
  /// The whole file; nothing can be added then.
  std::string finish();

 private:
  struct ChunkIndex {
    Nanoseconds first = 0, last = 0;
    std::uint64_t offset = 0, length = 0, index_length = 0, packed = 0, unpacked = 0;
    std::map<std::uint16_t, std::uint64_t> index_offsets;
  };
  void end_chunk();
  std::string statistics() const;
  std::string chunk_index(const ChunkIndex& c) const;

  std::string file_, chunk_, topics_;
  std::map<std::uint16_t, std::vector<std::pair<Nanoseconds, std::uint64_t>>> index_;  ///< of the open chunk
  std::vector<ChunkIndex> chunks_;
  std::map<std::uint16_t, std::uint64_t> counts_;
  Nanoseconds first_ = 0, last_ = 0, chunk_first_ = 0, chunk_last_ = 0;
  std::uint32_t sequence_ = 0;
};

}  // namespace umbsim::exchange::mcap
