#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"

namespace umbsim {

/// A CSV file of numbers, read strictly cell by cell. Every error is an InputError with file:line:column, the name of
/// the column and the text of the cell.
class CsvReader {
 public:
  using Header = std::vector<std::string_view>;

  /// Throws if the file cannot be read, is empty, or its first line is none of `headers`.
  CsvReader(const std::filesystem::path& file, const std::vector<Header>& headers);

  /// Which of the constructor's headers the file has.
  std::size_t header_index() const { return header_index_; }
  std::size_t columns() const { return header_.size(); }

  /// Goes to the next row; false after the last. All the cells of a row must be read before the next one.
  bool next_row();
  /// The next cell of the row. Throws unless it is finite and within +-kMaxCsvNumber.
  double number();
  /// The next cell of the row. Throws unless it is an integer that a double can hold exactly.
  std::int64_t integer();
  /// The first cell, which must be larger than that of the row before.
  double increasing_time_s();
  /// A rough count of rows, for reserving memory.
  std::size_t estimated_rows() const;

  /// Refuses the file as a whole.
  [[noreturn]] void fail_file(const std::string& what) const;

 private:
  void read_header(const std::vector<Header>& headers);
  std::string_view next_cell();
  [[noreturn]] void fail_cell(const std::string& what) const;
  [[noreturn]] void fail_row(const std::string& what) const;

  std::string file_;
  std::string text_;
  Header header_;
  std::size_t header_index_ = 0;
  std::size_t line_start_ = 0;
  std::size_t cell_start_ = 0;
  std::size_t position_ = 0;
  std::size_t column_ = 0;  ///< cells of the row already taken
  int line_ = 1;
  int rows_ = 0;
  double previous_time_s_ = 0;
};

/// Largest magnitude of a number in a recording's CSV file: seconds since any epoch fit, and squares stay finite.
constexpr double kMaxCsvNumber = 1e12;
constexpr std::int64_t kMaxCsvInteger = std::int64_t(1) << 53;  // every integer up to it is a double, too

}  // namespace umbsim
