#include "exchange/text/columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace umbsim::exchange {
namespace {

// A row every so many units: seconds are never so many, milliseconds never so few.
constexpr double kSecondsBelow = 0.45;
constexpr double kMillisFrom = 1.5, kMillisBelow = 300;
constexpr double kMicrosFrom = 1500, kMicrosBelow = 3e5;
constexpr double kNanosFrom = 1.5e6;

std::int64_t ns_of(const std::string& unit) {
  return unit == "ms" ? 1'000'000 : unit == "us" ? 1'000 : unit == "ns" ? 1 : 1'000'000'000;
}

bool is_time_unit(const std::string& unit) { return unit == "s" || unit == "ms" || unit == "us" || unit == "ns"; }

}  // namespace

Columns::Columns(Table table) : table_(std::move(table)) {
  table_.check_even();
  for (std::size_t i = 0; i < table_.cells(0); ++i) meanings_.push_back(meaning_of(name(i)));
}

std::string Columns::name(std::size_t column) const {
  return table_.names().empty() ? fmt::format("column {}", column + 1) : table_.names()[column];
}

std::vector<std::size_t> Columns::of(Role role) const {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < meanings_.size(); ++i) {
    if (meanings_[i].role == role) found.push_back(i);
  }
  return found;
}

std::string Columns::list() const {
  std::string text;
  for (std::size_t i = 0; i < count() && i < 40; ++i) text += (i ? ", " : "") + name(i);
  return count() > 40 ? text + ", ..." : text;
}

std::size_t Columns::named(const std::string& wanted, const std::string& option) const {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < count(); ++i) {
    if (name(i) == wanted) return i;
    if (name(i).ends_with(wanted)) found.push_back(i);
  }
  if (found.size() == 1) return found.front();
  const bool number = !wanted.empty() && wanted.size() < 6 && wanted.find_first_not_of("0123456789") == wanted.npos;
  if (number && std::stoul(wanted) >= 1 && std::stoul(wanted) <= count()) return std::stoul(wanted) - 1;
  throw InputError(fmt::format("{}: {} {}: {}; there are: {}", table_.file(), option, wanted,
                               found.empty() ? "no column has this name" : "several columns end so", list()));
}

std::size_t Columns::choose(const std::vector<std::size_t>& candidates, const std::string& wanted,
                            const std::string& option, const std::string& what) const {
  if (!wanted.empty()) return named(wanted, option);
  if (candidates.size() == 1) return candidates.front();
  std::string names;
  for (const std::size_t c : candidates) names += (names.empty() ? "" : ", ") + name(c);
  throw InputError(
      candidates.empty()
          ? fmt::format("{}: no column says that it is {}: give {}; there are: {}", table_.file(), what, option, list())
          : fmt::format("{}: several columns may be {}: {}; choose one with {}", table_.file(), what, names, option));
}

std::int64_t Columns::time_unit_ns(std::size_t column, const std::string& said, std::string& how) const {
  if (!said.empty()) {
    how = said + ", as given";
    return ns_of(said);
  }
  if (is_time_unit(meanings_[column].unit)) {
    how = meanings_[column].unit;
    return ns_of(how);
  }
  std::vector<double> steps;
  for (std::size_t row = 1; row < table_.rows(); ++row) {
    steps.push_back(table_.number(row, column) - table_.number(row - 1, column));
  }
  if (steps.empty()) table_.fail_file("has fewer than two rows");
  std::nth_element(steps.begin(), steps.begin() + std::ptrdiff_t(steps.size() / 2), steps.end());
  const double usual = steps[steps.size() / 2];
  const std::string unit = usual > 0 && usual < kSecondsBelow             ? "s"
                           : usual >= kMillisFrom && usual < kMillisBelow ? "ms"
                           : usual >= kMicrosFrom && usual < kMicrosBelow ? "us"
                           : usual >= kNanosFrom                          ? "ns"
                                                                          : "";
  if (unit.empty()) {
    throw InputError(
        fmt::format("{}: the unit of column '{}' cannot be told (it grows by {:g} from row to row): give "
                    "--time-unit s, ms, us or ns",
                    table_.file(), name(column), usual));
  }
  how = fmt::format("{}, told by its steps of {:g}", unit, usual);
  return ns_of(unit);
}

}  // namespace umbsim::exchange
