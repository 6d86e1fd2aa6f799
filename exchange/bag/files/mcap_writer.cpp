#include "exchange/bag/files/mcap_writer.h"

#include <zstd.h>

#include <cstring>

#include "core/error.h"
#include "exchange/bag/files/mcap_records.h"

namespace umbsim::exchange::mcap {
namespace {

constexpr std::size_t kChunkBytes = 1 << 20;
constexpr int kLevel = 3;

template <class T>
void put(std::string& out, T value) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));
  out.append(bytes, sizeof(T));
}

void put_text(std::string& out, std::string_view text) {
  put(out, std::uint32_t(text.size()));
  out += text;
}

void put_record(std::string& out, Opcode opcode, const std::string& content) {
  out += char(opcode);
  put(out, std::uint64_t(content.size()));
  out += content;
}

}  // namespace

Writer::Writer(std::string_view profile, std::string_view library) : file_(kMagic) {
  std::string header;
  put_text(header, profile);
  put_text(header, library);
  put_record(file_, kHeader, header);
}

std::uint16_t Writer::add_topic(const std::string& topic, const std::string& type, const std::string& definition) {
  const auto id = std::uint16_t(counts_.size() + 1);
  std::string schema, channel;
  put(schema, id);
  put_text(schema, type);
  put_text(schema, "ros2msg");
  put_text(schema, definition);
  put(channel, id);
  put(channel, id);
  put_text(channel, topic);
  put_text(channel, "cdr");
  put(channel, std::uint32_t(0));
  std::string records;
  put_record(records, kSchema, schema);
  put_record(records, kChannel, channel);
  topics_ += records;
  file_ += records;  // before the first chunk
  counts_[id] = 0;
  return id;
}

void Writer::add(std::uint16_t channel, Nanoseconds at, std::string_view data) {
  if (counts_[channel] == 0 && sequence_ == 0) first_ = at;
  if (chunk_.empty()) chunk_first_ = at;
  chunk_last_ = last_ = at;
  index_[channel].emplace_back(at, chunk_.size());
  std::string message;
  put(message, channel);
  put(message, sequence_++);
  put(message, std::uint64_t(at));
  put(message, std::uint64_t(at));
  message += data;
  put_record(chunk_, kMessage, message);
  ++counts_[channel];
  if (chunk_.size() > kChunkBytes) end_chunk();
}

void Writer::end_chunk() {
  if (chunk_.empty()) return;
  std::string packed(ZSTD_compressBound(chunk_.size()), '\0');
  const std::size_t size = ZSTD_compress(packed.data(), packed.size(), chunk_.data(), chunk_.size(), kLevel);
  if (ZSTD_isError(size)) throw RunError("zstd cannot pack a chunk");
  packed.resize(size);
  ChunkIndex c{chunk_first_, chunk_last_, file_.size(), 0, 0, size, chunk_.size(), {}};
  std::string record;
  put(record, std::uint64_t(chunk_first_));
  put(record, std::uint64_t(chunk_last_));
  put(record, std::uint64_t(chunk_.size()));
  put(record, crc32_of(chunk_.data(), chunk_.size()));
  put_text(record, "zstd");
  put(record, std::uint64_t(size));
  record += packed;
  put_record(file_, kChunk, record);
  c.length = file_.size() - c.offset;
  for (const auto& [channel, entries] : index_) {
    c.index_offsets[channel] = file_.size();
    std::string index;
    put(index, channel);
    put(index, std::uint32_t(16 * entries.size()));
    for (const auto& [at, offset] : entries) {
      put(index, std::uint64_t(at));
      put(index, offset);
    }
    put_record(file_, kMessageIndex, index);
  }
  c.index_length = file_.size() - c.offset - c.length;
  chunks_.push_back(std::move(c));
  chunk_.clear();
  index_.clear();
}

std::string Writer::statistics() const {
  std::string s;
  put(s, std::uint64_t(sequence_));
  put(s, std::uint16_t(counts_.size()));
  put(s, std::uint32_t(counts_.size()));
  put(s, std::uint32_t(0));
  put(s, std::uint32_t(0));
  put(s, std::uint32_t(chunks_.size()));
  put(s, std::uint64_t(first_));
  put(s, std::uint64_t(last_));
  put(s, std::uint32_t(10 * counts_.size()));
  for (const auto& [channel, count] : counts_) {
    put(s, channel);
    put(s, count);
  }
  return s;
}

std::string Writer::chunk_index(const ChunkIndex& c) const {
  std::string s;
  put(s, std::uint64_t(c.first));
  put(s, std::uint64_t(c.last));
  put(s, c.offset);
  put(s, c.length);
  put(s, std::uint32_t(10 * c.index_offsets.size()));
  for (const auto& [channel, offset] : c.index_offsets) {
    put(s, channel);
    put(s, offset);
  }
  put(s, c.index_length);
  put_text(s, "zstd");
  put(s, c.packed);
  put(s, c.unpacked);
  return s;
}

std::string Writer::finish() {
  end_chunk();
  std::string end;
  put(end, std::uint32_t(0));
  put_record(file_, kDataEnd, end);
  const std::size_t summary = file_.size();
  file_ += topics_;
  put_record(file_, kStatistics, statistics());
  for (const ChunkIndex& c : chunks_) put_record(file_, kChunkIndex, chunk_index(c));
  // The footer's checksum covers the summary and the footer's own first fields.
  std::string footer;
  put(footer, std::uint64_t(summary));
  put(footer, std::uint64_t(0));
  std::string covered = file_.substr(summary);
  covered += char(kFooter);
  put(covered, std::uint64_t(20));
  covered += footer;
  put(footer, crc32_of(covered.data(), covered.size()));
  put_record(file_, kFooter, footer);
  file_ += kMagic;
  return std::move(file_);
}

}  // namespace umbsim::exchange::mcap
