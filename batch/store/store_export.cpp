#include "batch/store/store_export.h"

#include <fmt/compile.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <nlohmann/json.hpp>

#include "core/error.h"

namespace umbsim {
namespace {

constexpr std::size_t kBlock = std::size_t(1) << 20;

/// Standard output, or a file that takes its name when it is complete.
class Sink {
 public:
  explicit Sink(const std::filesystem::path& file) : file_(file) {
    if (file_.empty()) return;
    part_ = file_;
    part_ += fmt::format(".{}.part", getpid());
    stream_ = std::fopen(part_.c_str(), "wb");
    if (!stream_) fail("cannot be written");
  }
  ~Sink() {
    if (file_.empty() || !stream_) return;
    std::fclose(stream_);
    std::remove(part_.c_str());
  }
  Sink(const Sink&) = delete;
  Sink& operator=(const Sink&) = delete;

  void write_block(bool last = false) {
    if (!last && text.size() < kBlock) return;
    if (std::fwrite(text.data(), 1, text.size(), stream_) != text.size()) fail("cannot be written completely");
    text.clear();
  }

  void finish() {
    write_block(true);
    if (std::fflush(stream_) != 0) fail("cannot be written completely");
    if (file_.empty()) return;
    const int closed = std::fclose(stream_);
    stream_ = nullptr;
    if (closed != 0 || std::rename(part_.c_str(), file_.c_str()) != 0) fail("cannot be written completely");
  }

  fmt::memory_buffer text;

 private:
  [[noreturn]] void fail(const char* what) const {
    const std::string name = file_.empty() ? "standard output" : file_.string();
    throw RunError(fmt::format("{}: {}: {}", name, what, std::strerror(errno)));
  }
  std::filesystem::path file_, part_;
  std::FILE* stream_ = stdout;
};

void append(fmt::memory_buffer& out, std::string_view text) { out.append(text.data(), text.data() + text.size()); }

// RFC 4180.
void append_csv_text(fmt::memory_buffer& out, const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return append(out, text);
  out.push_back('"');
  for (const char c : text) {
    if (c == '"') out.push_back('"');
    out.push_back(c);
  }
  out.push_back('"');
}

// Nearly all cells are numbers: the format is compiled, and none becomes a Cell first.
bool append_number(fmt::memory_buffer& out, const Statement& rows, int column) {
  const std::optional<double> number = rows.number(column);
  if (!number || !std::isfinite(*number)) return false;
  fmt::format_to(fmt::appender(out), FMT_COMPILE("{}"), *number);
  return true;
}

void append_cell(fmt::memory_buffer& out, const Cell& cell, bool json) {
  if (const auto* integer = std::get_if<std::int64_t>(&cell)) fmt::format_to(std::back_inserter(out), "{}", *integer);
  else if (const auto* text = std::get_if<std::string>(&cell)) {
    if (json) append(out, nlohmann::json(*text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
    else append_csv_text(out, *text);
  } else if (json) {
    append(out, "null");
  }
}

// All columns but those that are empty in every row.
std::vector<std::string> filled_columns(Store& store, const std::vector<Condition>& where) {
  const std::vector<std::string> all = store.columns();
  std::vector<bool> filled(all.size(), false);
  std::size_t left = all.size();
  Statement rows = store.select(all, where, "--where");
  std::vector<std::size_t> open(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) open[i] = i;
  // Rows are alike: after the first ones only few columns are still to be looked at.
  while (left > 0 && rows.step()) {
    std::erase_if(open, [&](std::size_t i) {
      if (rows.is_null(int(i))) return false;
      filled[i] = true;
      --left;
      return true;
    });
  }
  std::vector<std::string> names;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (filled[i]) names.push_back(all[i]);
  }
  return names.empty() ? all : names;
}

void write_header(Sink& sink, const Store& store, const std::vector<std::string>& columns, bool json) {
  if (json) {
    append(sink.text,
           fmt::format("{{\"format\": \"umbsim-sweep-export/1\", \"sweep\": {},\n \"columns\": {},\n \"rows\": [",
                       nlohmann::json(store.layout().name).dump(), nlohmann::json(columns).dump()));
    return;
  }
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (i > 0) sink.text.push_back(',');
    append_csv_text(sink.text, columns[i]);
  }
  sink.text.push_back('\n');
}

void write_row(Sink& sink, const Statement& rows, bool json, bool first) {
  if (json) append(sink.text, first ? "\n  [" : ",\n  [");
  for (int i = 0; i < rows.columns(); ++i) {
    if (i > 0) append(sink.text, json ? ", " : ",");
    if (!append_number(sink.text, rows, i)) append_cell(sink.text, rows.cell(i), json);
  }
  append(sink.text, json ? "]" : "\n");
}

}  // namespace

std::int64_t export_store(Store& store, const ExportChoice& choice) {
  const std::vector<std::string> columns =
      choice.columns.empty() ? filled_columns(store, choice.where) : choice.columns;
  Statement rows = store.select(columns, choice.where, choice.columns.empty() ? "--where" : "--columns or --where");
  Sink sink(choice.file);
  write_header(sink, store, columns, choice.json);
  std::int64_t count = 0;
  for (; rows.step(); ++count) {
    write_row(sink, rows, choice.json, count == 0);
    sink.write_block();
  }
  if (choice.json) append(sink.text, "\n]}\n");
  sink.finish();
  return count;
}

}  // namespace umbsim
