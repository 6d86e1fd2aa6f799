#pragma once

#include <optional>
#include <string>
#include <vector>

#include "exchange/text/column_meaning.h"
#include "exchange/text/table.h"

namespace umbsim::exchange {

/// A table whose columns have names, and what they mean.
class Columns {
 public:
  explicit Columns(Table table);

  const Table& table() const { return table_; }
  const ColumnMeaning& meaning(std::size_t column) const { return meanings_[column]; }
  std::string name(std::size_t column) const;
  std::size_t count() const { return meanings_.size(); }
  std::vector<std::size_t> of(Role role) const;

  /// The column of an option's value: a name, the end of one, or a number from 1 on. Throws InputError that lists them.
  std::size_t named(const std::string& wanted, const std::string& option) const;

  /// The column that `option` names, else the only one of `candidates`. Throws InputError that asks for `option`.
  std::size_t choose(const std::vector<std::size_t>& candidates, const std::string& wanted, const std::string& option,
                     const std::string& what) const;

  /// Nanoseconds in a unit of the time column; `said`: of the option, else of the column's name, else by its steps.
  std::int64_t time_unit_ns(std::size_t column, const std::string& said, std::string& how) const;

  std::string list() const;

 private:
  Table table_;
  std::vector<ColumnMeaning> meanings_;
};

}  // namespace umbsim::exchange
