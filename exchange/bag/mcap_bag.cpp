#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <stdexcept>

#include "core/error.h"
#include "core/progress.h"
#include "exchange/bag/bag.h"
#include "exchange/bag/files/mapped_file.h"
#include "exchange/bag/files/mcap_records.h"
#include "exchange/bag/files/unpacked_file.h"

namespace umbsim::exchange {
namespace {

using mcap::Fields;

constexpr std::size_t kRecordHead = 9;  // opcode and length
constexpr std::size_t kFooterBytes = 20;

struct Schema {
  std::string name, encoding, text;
};

class McapBag : public Bag {
 public:
  McapBag(const std::string& file, const UnpackedFile* unpacked)
      : file_(file), map_(unpacked ? unpacked->path() : file) {
    check_ends();
    // Chunks hold schemas and channels again before their messages; one pass finds all of them.
    read({}, {});
  }

  const std::vector<Topic>& topics() const override { return topics_; }

  void read(const std::set<std::size_t>& wanted, const std::function<void(const BagMessage&)>& take) const override {
    try {
      Progress progress("reading " + std::filesystem::path(file_).filename().string(), 100);
      records(Fields(map_.data() + mcap::kMagic.size(), map_.size() - 2 * mcap::kMagic.size()), wanted, take,
              &progress);
    } catch (const std::out_of_range&) {
      throw InputError(SourceMark{file_}, "is damaged: a record goes beyond its end");
    } catch (const InputError& e) {
      const std::string what = e.what();
      if (what.starts_with(file_)) throw;
      throw InputError(SourceMark{file_}, what);
    }
  }

 private:
  void check_ends() const {
    const std::size_t size = map_.size(), magic = mcap::kMagic.size();
    const auto text_at = [&](std::size_t at) {
      return std::string_view(reinterpret_cast<const char*>(map_.data() + at), magic);
    };
    if (size < magic || text_at(0) != mcap::kMagic) throw InputError(SourceMark{file_}, "is not an MCAP file");
    if (size < 2 * magic + kRecordHead + kFooterBytes || text_at(size - magic) != mcap::kMagic) {
      throw InputError(SourceMark{file_},
                       "is cut off: it does not end as MCAP files do (was the recorder killed?); `mcap "
                       "recover` repairs it");
    }
  }

  // Remembers what a record defines; passes messages on.
  void records(Fields in, const std::set<std::size_t>& wanted, const std::function<void(const BagMessage&)>& take,
               Progress* progress) const {
    while (in.left() >= kRecordHead) {
      if (progress) progress->reach(int(100 - 100 * in.left() / map_.size()));
      const auto opcode = in.number<std::uint8_t>();
      const auto size = in.number<std::uint64_t>();
      Fields record(in.take(size), size);
      if (opcode == mcap::kMessage) {
        message(record, wanted, take);
      } else if (opcode == mcap::kChunk) {
        chunk(record, wanted, take);
      } else if (opcode == mcap::kSchema) {
        schema(record);
      } else if (opcode == mcap::kChannel) {
        channel(record);
      } else if (opcode == mcap::kDataEnd) {
        return;  // what follows is said already
      }
    }
  }

  void chunk(Fields& in, const std::set<std::size_t>& wanted,
             const std::function<void(const BagMessage&)>& take) const {
    in.take(16);  // first and last time
    const auto size = in.number<std::uint64_t>();
    const auto crc = in.number<std::uint32_t>();
    const std::string compression = in.text();
    const auto packed = in.number<std::uint64_t>();
    const std::vector<std::uint8_t> bytes = mcap::unpacked(compression, in.take(packed), packed, size, crc);
    records(Fields(bytes.data(), bytes.size()), wanted, take, nullptr);
  }

  void schema(Fields& in) const {
    const auto id = in.number<std::uint16_t>();
    std::string name = in.text();
    std::string encoding = in.text();
    schemas_[id] = {std::move(name), std::move(encoding), in.text()};
  }

  void channel(Fields& in) const {
    const auto id = in.number<std::uint16_t>();
    const auto schema_id = in.number<std::uint16_t>();
    const std::string topic = in.text();
    const std::string encoding = in.text();
    if (channels_.count(id)) return;
    const Schema& s = schemas_[schema_id];
    channels_[id] = topics_.size();
    topics_.push_back({topic, short_type(s.name), s.text, s.encoding, encoding});
  }

  void message(Fields& in, const std::set<std::size_t>& wanted,
               const std::function<void(const BagMessage&)>& take) const {
    const auto id = in.number<std::uint16_t>();
    in.take(4);
    const auto logged = Nanoseconds(in.number<std::uint64_t>());
    in.take(8);
    const auto found = channels_.find(id);
    if (found == channels_.end())
      throw InputError(fmt::format("is damaged: a message of channel {}, which is unknown", id));
    if (wanted.count(found->second)) take({found->second, logged, in.here(), in.left()});
  }

  std::string file_;
  MappedFile map_;
  mutable std::map<std::uint16_t, Schema> schemas_;
  mutable std::map<std::uint16_t, std::size_t> channels_;
  mutable std::vector<Topic> topics_;
};

}  // namespace

std::unique_ptr<Bag> open_mcap(const std::string& file, const UnpackedFile* unpacked) {
  return std::make_unique<McapBag>(file, unpacked);
}

}  // namespace umbsim::exchange
