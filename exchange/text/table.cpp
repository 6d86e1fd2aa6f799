#include "exchange/text/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/error.h"
#include "core/text/text_file.h"

namespace umbsim::exchange {
namespace {

constexpr std::size_t kLargest = std::size_t(2) << 30;
constexpr std::size_t kLooks = 50;  // lines from which the dialect is told

std::string_view trimmed(std::string_view text) {
  const char* kBlank = " \t\r";
  const std::size_t from = text.find_first_not_of(kBlank);
  if (from == std::string_view::npos) return {};
  return text.substr(from, text.find_last_not_of(kBlank) - from + 1);
}

std::string_view unquoted(std::string_view cell) {
  cell = trimmed(cell);
  if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"') return trimmed(cell.substr(1, cell.size() - 2));
  return cell;
}

std::string shown(std::string_view cell) {
  std::string text(cell.substr(0, 40));
  return cell.size() > 40 ? text + "..." : text;
}

// "-12,5": digits on both sides of one comma.
bool has_decimal_comma(std::string_view cell) {
  const std::size_t at = cell.find(',');
  return at != std::string_view::npos && at > 0 && at + 1 < cell.size() &&
         cell.find_first_not_of("+-0123456789,eE") == std::string_view::npos && cell.find(',', at + 1) == cell.npos;
}

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = text.find('\n', at);
    if (end == std::string_view::npos) end = text.size();
    lines.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}

}  // namespace

void Table::split(std::string_view line, std::vector<std::string_view>& cells) const {
  cells.clear();
  if (delimiter_ == ' ') {
    line = trimmed(line);
    while (!line.empty()) {
      const std::size_t end = std::min(line.find_first_of(" \t"), line.size());
      cells.push_back(unquoted(line.substr(0, end)));
      line = trimmed(line.substr(end));
    }
    return;
  }
  std::size_t from = 0;
  bool quoted = false;
  for (std::size_t i = 0; i <= line.size(); ++i) {
    if (i < line.size() && line[i] == '"') quoted = !quoted;
    if (i < line.size() && (line[i] != delimiter_ || quoted)) continue;
    cells.push_back(unquoted(line.substr(from, i - from)));
    from = i + 1;
  }
}

// The delimiter is the one that every line has; a comma beside another one is a decimal sign.
void Table::find_dialect() {
  std::vector<std::string_view> looked_at;
  for (const std::string_view line : lines_of(std::string_view(*text_).substr(0, kLooks * 4096))) {
    const std::string_view text = trimmed(line);
    if (!text.empty() && text.front() != '#') looked_at.push_back(line);
    if (looked_at.size() == kLooks) break;
  }
  if (looked_at.size() > 1) looked_at.pop_back();  // it may be cut off
  delimiter_ = ' ';
  for (const char candidate : {';', '\t', ','}) {
    const bool everywhere = std::all_of(looked_at.begin(), looked_at.end(), [&](std::string_view line) {
      return line.find(candidate) != std::string_view::npos;
    });
    if (!everywhere) continue;
    delimiter_ = candidate;
    break;
  }
  std::vector<std::string_view> cells;
  bool point = false;
  for (const std::string_view line : looked_at) {
    split(line, cells);
    for (const std::string_view cell : cells) {
      decimal_comma_ = decimal_comma_ || has_decimal_comma(cell);
      double ignored = 0;
      const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), ignored);
      point = point || (error == std::errc() && end == cell.data() + cell.size() && cell.find('.') != cell.npos);
    }
  }
  if (decimal_comma_ && point) fail_file("mixes decimal points and decimal commas: write all numbers alike");
}

void Table::take_header(const std::vector<std::string_view>& first, bool commented) {
  double ignored = 0;
  const bool numbers = std::any_of(first.begin(), first.end(), [&](std::string_view c) { return parse(c, ignored); });
  if (numbers && !commented) return;
  for (const std::string_view name : first) names_.emplace_back(name);
}

Table Table::read(const std::filesystem::path& file) {
  Table table;
  table.file_ = file.string();
  std::string text = read_text_file(file, kLargest);
  if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);
  if (text.find('\0') != std::string::npos) table.fail_file("is not a text file");
  table.text_ = std::make_shared<const std::string>(std::move(text));
  table.find_dialect();
  std::vector<std::string_view> cells, comment;
  int number = 0;
  bool first = true;
  for (std::string_view line : lines_of(*table.text_)) {
    ++number;
    const std::string_view text_of_line = trimmed(line);
    if (text_of_line.empty()) continue;
    const bool commented = text_of_line.front() == '#';
    table.split(commented ? text_of_line.substr(1) : line, cells);
    if (commented) {
      if (first) comment = cells;
      continue;
    }
    if (first) {
      first = false;
      table.take_header(cells, false);
      if (!table.names_.empty()) continue;
      if (comment.size() == cells.size()) table.take_header(comment, true);
    }
    table.cells_.insert(table.cells_.end(), cells.begin(), cells.end());
    table.starts_.push_back(table.cells_.size());
    table.lines_.push_back(number);
  }
  if (table.rows() == 0) table.fail_file("holds no rows of numbers");
  return table;
}

std::string Table::dialect() const {
  const std::string sign = delimiter_ == ' ' ? "blanks" : delimiter_ == '\t' ? "tabs" : fmt::format("'{}'", delimiter_);
  return fmt::format("columns parted by {}, decimal {}", sign, decimal_comma_ ? "comma" : "point");
}

bool Table::parse(std::string_view cell, double& value) const {
  if (cell.starts_with('+')) cell.remove_prefix(1);
  std::string with_point;
  if (decimal_comma_) {
    with_point = cell;
    std::replace(with_point.begin(), with_point.end(), ',', '.');
    cell = with_point;
  }
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return error == std::errc() && end == cell.data() + cell.size() && !cell.empty();
}

bool Table::is_number(std::size_t row, std::size_t column) const {
  double ignored = 0;
  return parse(cell(row, column), ignored);
}

double Table::number(std::size_t row, std::size_t column) const {
  double value = 0;
  if (!parse(cell(row, column), value))
    fail(row, column, fmt::format("'{}' is not a number", shown(cell(row, column))));
  if (!std::isfinite(value)) fail(row, column, fmt::format("{} is not a finite number", shown(cell(row, column))));
  return value;
}

Nanoseconds Table::time(std::size_t row, std::size_t column, std::int64_t unit_ns) const {
  const double value = number(row, column);
  constexpr double kLatest_ns = 9e18;
  if (std::abs(value) * double(unit_ns) > kLatest_ns) {
    fail(row, column, fmt::format("{} is no time in this unit", shown(cell(row, column))));
  }
  // Digit by digit: seconds since 1970 with nine decimals do not fit into a double.
  const std::string_view text = cell(row, column);
  const bool plain = text.find_first_not_of("+-0123456789.,") == std::string_view::npos;
  if (!plain) return Nanoseconds(std::llround(value * double(unit_ns)));
  Nanoseconds whole = 0, part = 0;
  std::int64_t scale = unit_ns;
  bool after_sign = false;
  for (const char c : text) {
    if (c == '.' || c == ',') after_sign = true;
    if (c < '0' || c > '9') continue;
    if (!after_sign)
      whole = 10 * whole + (c - '0');
    else if (scale % 10 == 0)
      part += (c - '0') * (scale /= 10);
  }
  const Nanoseconds size = whole * unit_ns + part;
  return text.starts_with('-') ? -size : size;
}

void Table::check_even() const {
  const std::size_t expected = names_.empty() ? cells(0) : names_.size();
  for (std::size_t row = 0; row < rows(); ++row) {
    if (cells(row) == expected) continue;
    const bool last = row + 1 == rows();
    throw InputError(SourceMark{file_, lines_[row], 1},
                     fmt::format("the row has {} cells, the others {}{}", cells(row), expected,
                                 last ? ": the file is cut off, delete the row" : ""));
  }
}

std::string Table::label(std::size_t column) const {
  return column < names_.size() ? names_[column] : fmt::format("column {}", column + 1);
}

void Table::fail(std::size_t row, std::size_t column, const std::string& what) const {
  throw InputError(SourceMark{file_, lines_[row], 0}, fmt::format("{}: {}", label(column), what));
}

void Table::fail_file(const std::string& what) const { throw InputError(SourceMark{file_}, what); }

}  // namespace umbsim::exchange
