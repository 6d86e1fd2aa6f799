#include <fmt/format.h>
#include <sqlite3.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <map>

#include "core/error.h"
#include "core/progress.h"
#include "exchange/bag/bag.h"
#include "exchange/bag/files/unpacked_file.h"

namespace umbsim::exchange {
namespace {

/// One SQL statement, row by row.
class Query {
 public:
  Query(sqlite3* db, const std::string& file, const std::string& sql) : db_(db), file_(file) {
    if (sqlite3_prepare_v2(db, sql.c_str(), -1, &statement_, nullptr) != SQLITE_OK) fail();
  }
  ~Query() { sqlite3_finalize(statement_); }
  Query(const Query&) = delete;
  Query& operator=(const Query&) = delete;

  bool next() {
    const int result = sqlite3_step(statement_);
    if (result != SQLITE_ROW && result != SQLITE_DONE) fail();
    return result == SQLITE_ROW;
  }
  std::int64_t integer(int column) const { return sqlite3_column_int64(statement_, column); }
  std::string text(int column) const {
    const auto* bytes = reinterpret_cast<const char*>(sqlite3_column_text(statement_, column));
    return bytes ? std::string(bytes, std::size_t(sqlite3_column_bytes(statement_, column))) : "";
  }
  const std::uint8_t* blob(int column, std::size_t& size) const {
    const void* bytes = sqlite3_column_blob(statement_, column);
    size = std::size_t(sqlite3_column_bytes(statement_, column));
    return static_cast<const std::uint8_t*>(bytes);
  }

 private:
  [[noreturn]] void fail() const {
    throw InputError(SourceMark{file_}, fmt::format("is no whole rosbag2 file: SQLite says: {}", sqlite3_errmsg(db_)));
  }
  sqlite3* db_;
  const std::string& file_;
  sqlite3_stmt* statement_ = nullptr;
};

// SQLite reads a file without its last pages until it needs them: its header says how many there are.
void check_length(const std::string& file, const std::string& path) {
  std::array<unsigned char, 100> head{};
  std::ifstream in(path, std::ios::binary);
  in.read(reinterpret_cast<char*>(head.data()), std::streamsize(head.size()));
  const auto number = [&](std::size_t at) {
    return std::uint64_t(head[at]) << 24 | std::uint64_t(head[at + 1]) << 16 | std::uint64_t(head[at + 2]) << 8 |
           head[at + 3];
  };
  const std::uint64_t page = head[16] == 0 && head[17] == 1 ? 65536 : std::uint64_t(head[16]) << 8 | head[17];
  const bool counted = number(24) == number(92) && number(28) > 0;  // by a version that keeps the count
  const std::uint64_t size = std::filesystem::file_size(path);
  if (!in || (counted && size < page * number(28))) {
    throw InputError(SourceMark{file}, fmt::format("is cut off: it has {} of {} bytes", size, page * number(28)));
  }
}

void check_closed(const std::string& file) {
  std::error_code ignored;
  const std::string log = file + "-wal";
  if (!std::filesystem::exists(log, ignored) || std::filesystem::file_size(log, ignored) == 0) return;
  throw InputError(SourceMark{file},
                   fmt::format("was not closed: what was recorded last lies in {}; `sqlite3 {} 'PRAGMA "
                               "wal_checkpoint'` puts it back",
                               log, file));
}

class Db3Bag : public Bag {
 public:
  Db3Bag(const std::string& file, const UnpackedFile* unpacked) : file_(file) {
    check_length(file, unpacked ? unpacked->path() : file);
    if (!unpacked) check_closed(file);
    if ((unpacked ? open_memory(*unpacked) : open_file()) != SQLITE_OK) {
      const std::string why = sqlite3_errmsg(db_);
      sqlite3_close(db_);
      throw InputError(SourceMark{file}, "cannot be read: " + why);
    }
    try {
      find_topics();
    } catch (...) {
      sqlite3_close(db_);
      throw;
    }
  }
  ~Db3Bag() override { sqlite3_close(db_); }

  const std::vector<Topic>& topics() const override { return topics_; }

  void read(const std::set<std::size_t>& wanted, const std::function<void(const BagMessage&)>& take) const override {
    std::map<std::int64_t, std::size_t> by_id;
    std::string list;
    for (const std::size_t topic : wanted) {
      by_id[ids_[topic]] = topic;
      list += fmt::format("{}{}", list.empty() ? "" : ",", ids_[topic]);
    }
    Query rows(
        db_, file_,
        "SELECT topic_id, timestamp, data FROM messages WHERE topic_id IN (" + list + ") ORDER BY timestamp, id");
    Query last(db_, file_, "SELECT max(id) FROM messages");
    const auto total = std::max<std::int64_t>(last.next() ? last.integer(0) : 0, 1);
    Progress progress("reading " + std::filesystem::path(file_).filename().string(), 100);
    for (std::int64_t row = 0; rows.next(); ++row) {
      progress.reach(int(100 * row / total));
      BagMessage m{by_id[rows.integer(0)], rows.integer(1), nullptr, 0};
      m.data = rows.blob(2, m.size);
      take(m);
    }
  }

 private:
  // Read only, and without the files that a write-ahead log would make beside it.
  int open_file() {
    const std::string uri = "file:" + escaped(std::filesystem::absolute(file_).string()) + "?mode=ro&immutable=1";
    return sqlite3_open_v2(uri.c_str(), &db_, SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, nullptr);
  }

  int open_memory(const UnpackedFile& unpacked) {
    constexpr std::size_t kWriteVersion = 18, kReadVersion = 19;  // 2: of a write-ahead log, which memory has not
    for (const std::size_t at : {kWriteVersion, kReadVersion}) unpacked.data()[at] = 1;
    const int result = sqlite3_open(":memory:", &db_);
    if (result != SQLITE_OK) return result;
    const auto size = sqlite3_int64(unpacked.size());
    return sqlite3_deserialize(db_, "main", unpacked.data(), size, size, SQLITE_DESERIALIZE_READONLY);
  }

  static std::string escaped(const std::string& path) {
    std::string out;
    for (const char c : path)
      out += c == '%' || c == '?' || c == '#' ? fmt::format("%{:02x}", int(c)) : std::string(1, c);
    return out;
  }

  void find_topics() {
    struct Definition {
      std::string encoding, text;
    };
    std::map<std::string, Definition> definitions;
    Query tables(db_, file_, "SELECT name FROM sqlite_master WHERE type='table' AND name='message_definitions'");
    if (tables.next()) {
      Query rows(db_, file_, "SELECT topic_type, encoding, encoded_message_definition FROM message_definitions");
      while (rows.next()) definitions[rows.text(0)] = {rows.text(1), rows.text(2)};
    }
    Query rows(db_, file_, "SELECT id, name, type, serialization_format FROM topics ORDER BY id");
    while (rows.next()) {
      const std::string type = rows.text(2);
      const auto d = definitions.find(type);
      ids_.push_back(rows.integer(0));
      topics_.push_back({rows.text(1), short_type(type), d == definitions.end() ? "" : d->second.text,
                         d == definitions.end() ? "" : d->second.encoding, rows.text(3)});
    }
  }

  std::string file_;
  sqlite3* db_ = nullptr;
  std::vector<Topic> topics_;
  std::vector<std::int64_t> ids_;
};

}  // namespace

std::unique_ptr<Bag> open_db3(const std::string& file, const UnpackedFile* unpacked) {
  return std::make_unique<Db3Bag>(file, unpacked);
}

}  // namespace umbsim::exchange
