#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace umbsim {

/// One value of a table: nothing, a number or a text.
using Cell = std::variant<std::monostate, std::int64_t, double, std::string>;

bool is_number(const Cell& cell);
/// Not a number: NaN.
double number_of(const Cell& cell);
/// As people read it; numbers so that they read back as the same; nothing as an empty text.
std::string text_of_cell(const Cell& cell);
/// An integer, a number or else the text itself.
Cell cell_of(const std::string& text);

/// `key op value`: of a column of a table.
struct Condition {
  std::string key;
  std::string op;  ///< = != < <= > >=
  Cell value;
};

/// "course.side_m >= 2", "calibration.method = heading". Throws InputError that begins with `what`.
Condition parse_condition(const std::string& text, const std::string& what);

/// Numbers by value, texts by their letters; an empty cell or another kind of value fulfils nothing but !=.
bool fulfils(const Cell& cell, const Condition& condition);

/// SQL for the condition with one ? for its value.
std::string condition_sql(const Condition& condition);

}  // namespace umbsim
