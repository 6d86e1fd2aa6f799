#include "batch/condition.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <compare>
#include <limits>

#include "batch/store/sqlite.h"
#include "core/error.h"

namespace umbsim {
namespace {

// The longer ones first: "<=" is not "<" and then "=".
constexpr const char* kOperators[] = {"<=", ">=", "!=", "=", "<", ">"};

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t"), end = text.find_last_not_of(" \t");
  return begin == std::string::npos ? "" : text.substr(begin, end - begin + 1);
}

template <typename Number>
bool parse(const std::string& text, Number& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

bool holds(std::partial_ordering order, const std::string& op) {
  if (op == "=") return order == 0;
  if (op == "!=") return order != 0;
  if (op == "<") return order < 0;
  if (op == "<=") return order <= 0;
  return op == ">" ? order > 0 : order >= 0;
}

}  // namespace

bool is_number(const Cell& cell) {
  return std::holds_alternative<double>(cell) || std::holds_alternative<std::int64_t>(cell);
}

double number_of(const Cell& cell) {
  if (const auto* integer = std::get_if<std::int64_t>(&cell)) return double(*integer);
  if (const auto* number = std::get_if<double>(&cell)) return *number;
  return std::numeric_limits<double>::quiet_NaN();
}

std::string text_of_cell(const Cell& cell) {
  if (const auto* integer = std::get_if<std::int64_t>(&cell)) return fmt::format("{}", *integer);
  if (const auto* number = std::get_if<double>(&cell)) return fmt::format("{}", *number);
  const auto* text = std::get_if<std::string>(&cell);
  return text ? *text : std::string();
}

Cell cell_of(const std::string& text) {
  std::int64_t integer = 0;
  double number = 0;
  if (parse(text, integer)) return integer;
  if (parse(text, number) && std::isfinite(number)) return number;
  return text;
}

Condition parse_condition(const std::string& text, const std::string& what) {
  const std::size_t at = text.find_first_of("<>=!");
  for (const char* op : kOperators) {
    if (at == std::string::npos || text.compare(at, std::string(op).size(), op) != 0) continue;
    const Condition c{trimmed(text.substr(0, at)), op, cell_of(trimmed(text.substr(at + std::string(op).size())))};
    if (!c.key.empty() && text_of_cell(c.value) != "") return c;
  }
  throw InputError(fmt::format("{} '{}': must have the form key op value with op one of = != < <= > >=", what, text));
}

bool fulfils(const Cell& cell, const Condition& c) {
  if (is_number(cell) && is_number(c.value)) return holds(number_of(cell) <=> number_of(c.value), c.op);
  const auto *a = std::get_if<std::string>(&cell), *b = std::get_if<std::string>(&c.value);
  if (a && b) return holds(*a <=> *b, c.op);
  return c.op == "!=" && cell.index() != 0;
}

// typeof keeps SQLite from ordering every text above every number.
std::string condition_sql(const Condition& c) {
  const std::string column = quoted_name(c.key);
  const char* kind = is_number(c.value) ? "IN ('integer', 'real')" : "= 'text'";
  if (c.op == "!=") return fmt::format("({0} IS NOT NULL AND {0} != ?)", column);
  return fmt::format("(typeof({0}) {1} AND {0} {2} ?)", column, kind, c.op);
}

}  // namespace umbsim
