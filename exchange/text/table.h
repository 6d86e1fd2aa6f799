#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "exchange/import/log.h"

namespace umbsim::exchange {

/// A text file of rows and columns whose delimiter and decimal sign were found out.
class Table {
 public:
  /// Throws InputError: a file that cannot be read or holds no rows, a row with more or fewer cells than the others,
  /// a last row that is cut off. `ragged`: rows may differ in length, as `ros2 topic echo --csv` writes them.
  static Table read(const std::filesystem::path& file);

  const std::string& file() const { return file_; }
  /// "delimiter ';', decimal comma".
  std::string dialect() const;
  /// Names of the columns; empty where the file has no header.
  const std::vector<std::string>& names() const { return names_; }
  std::size_t rows() const { return starts_.size() - 1; }
  std::size_t cells(std::size_t row) const { return starts_[row + 1] - starts_[row]; }
  std::string_view cell(std::size_t row, std::size_t column) const { return cells_[starts_[row] + column]; }
  bool is_blank(std::size_t row, std::size_t column) const { return cell(row, column).empty(); }

  /// These throw InputError with file, line and the column's name: not a number, not finite.
  double number(std::size_t row, std::size_t column) const;
  /// `unit_ns`: nanoseconds of one unit. Exact where the text is a plain decimal.
  Nanoseconds time(std::size_t row, std::size_t column, std::int64_t unit_ns) const;
  bool is_number(std::size_t row, std::size_t column) const;

  [[noreturn]] void fail(std::size_t row, std::size_t column, const std::string& what) const;
  [[noreturn]] void fail_file(const std::string& what) const;
  /// Throws unless every row has as many cells as the header, or as the first row.
  void check_even() const;

 private:
  void split(std::string_view line, std::vector<std::string_view>& cells) const;
  void find_dialect();
  void take_header(const std::vector<std::string_view>& first, bool commented);
  bool parse(std::string_view cell, double& value) const;
  std::string label(std::size_t column) const;

  std::string file_;
  std::shared_ptr<const std::string> text_;  ///< cells point into it
  char delimiter_ = ',';                     ///< ' ' stands for any blanks
  bool decimal_comma_ = false;
  std::vector<std::string> names_;
  std::vector<std::string_view> cells_;
  std::vector<std::size_t> starts_{0};
  std::vector<int> lines_;
};

}  // namespace umbsim::exchange
