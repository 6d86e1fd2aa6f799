#include "recording/csv.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cmath>

#include "core/text/text_file.h"

namespace umbsim {
namespace {

constexpr std::size_t kMaxCsvBytes = std::size_t(1) << 30;
constexpr std::size_t kMaxShownCharacters = 60;
constexpr std::size_t kTypicalRowBytes = 24;

/// Text for a message: shortened, and with what cannot be printed written as \xNN.
std::string shown(std::string_view text) {
  std::string out;
  for (const char c : text.substr(0, kMaxShownCharacters)) {
    const auto byte = static_cast<unsigned char>(c);
    out += byte < 0x20 || byte >= 0x7f ? fmt::format("\\x{:02x}", byte) : std::string(1, c);
  }
  return out + (text.size() > kMaxShownCharacters ? "..." : "");
}

template <typename Number>
bool parse(std::string_view cell, Number& value) {
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return error == std::errc() && end == cell.data() + cell.size();
}

}  // namespace

CsvReader::CsvReader(const std::filesystem::path& file, const std::vector<Header>& headers)
    : file_(file.string()), text_(read_text_file(file, kMaxCsvBytes)) {
  if (text_.empty()) fail_file("the file is empty");
  read_header(headers);
}

void CsvReader::read_header(const std::vector<Header>& headers) {
  const std::size_t end = std::min(text_.find('\n'), text_.size());
  std::string_view line(text_.data(), end);
  if (line.ends_with('\r')) line.remove_suffix(1);
  position_ = std::min(end + 1, text_.size());
  for (header_index_ = 0; header_index_ < headers.size(); ++header_index_) {
    header_ = headers[header_index_];
    if (line == fmt::format("{}", fmt::join(header_, ","))) {
      column_ = header_.size();
      return;
    }
  }
  std::string expected;
  for (const Header& header : headers) {
    expected += fmt::format("{}'{}'", expected.empty() ? "" : " or ", fmt::join(header, ","));
  }
  throw InputError(SourceMark{file_, 1, 1}, fmt::format("header '{}' must be {}", shown(line), expected));
}

bool CsvReader::next_row() {
  if (position_ == text_.size()) return false;
  ++line_;
  ++rows_;
  column_ = 0;
  line_start_ = cell_start_ = position_;
  return true;
}

std::string_view CsvReader::next_cell() {
  cell_start_ = position_;
  std::size_t end = position_;
  while (end < text_.size() && text_[end] != ',' && text_[end] != '\n') ++end;
  const bool is_last = column_ + 1 == header_.size();
  if (end == text_.size()) fail_row("the row is cut short: it does not end with a line break");
  if (text_[end] == ',' && is_last) fail_row(fmt::format("the row has more than {} columns", header_.size()));
  if (text_[end] == '\n' && !is_last) {
    fail_row(
        fmt::format("the row has {} of {} columns; {} is missing", column_ + 1, header_.size(), header_[column_ + 1]));
  }
  ++column_;
  position_ = end + 1;
  std::string_view cell(text_.data() + cell_start_, end - cell_start_);
  if (is_last && cell.ends_with('\r')) cell.remove_suffix(1);
  return cell;
}

double CsvReader::number() {
  const std::string_view cell = next_cell();
  double value = 0;
  if (!parse(cell, value)) fail_cell(fmt::format("'{}' is not a number", shown(cell)));
  if (!std::isfinite(value)) fail_cell(fmt::format("'{}' is not a finite number", shown(cell)));
  if (std::abs(value) > kMaxCsvNumber) {
    fail_cell(fmt::format("{} is out of range (must be within +-{})", shown(cell), kMaxCsvNumber));
  }
  return value;
}

std::int64_t CsvReader::integer() {
  const std::string_view cell = next_cell();
  std::int64_t value = 0;
  if (!parse(cell, value)) fail_cell(fmt::format("'{}' is not an integer", shown(cell)));
  if (value > kMaxCsvInteger || value < -kMaxCsvInteger) {
    fail_cell(fmt::format("{} is out of range (must be within +-{})", value, kMaxCsvInteger));
  }
  return value;
}

double CsvReader::increasing_time_s() {
  const double time_s = number();
  if (rows_ > 1 && !(time_s > previous_time_s_)) {
    fail_cell(fmt::format("{} does not increase (must be > {}, the row before)", time_s, previous_time_s_));
  }
  previous_time_s_ = time_s;
  return time_s;
}

std::size_t CsvReader::estimated_rows() const { return text_.size() / kTypicalRowBytes + 1; }

void CsvReader::fail_file(const std::string& what) const { throw InputError(SourceMark{file_}, what); }

void CsvReader::fail_row(const std::string& what) const {
  throw InputError(SourceMark{file_, line_, int(cell_start_ - line_start_) + 1}, what);
}

void CsvReader::fail_cell(const std::string& what) const {
  throw InputError(SourceMark{file_, line_, int(cell_start_ - line_start_) + 1},
                   fmt::format("{}: {}", header_[column_ - 1], what));
}

}  // namespace umbsim
