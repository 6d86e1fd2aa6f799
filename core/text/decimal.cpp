#include "core/text/decimal.h"

#include <fmt/compile.h>

#include <charconv>
#include <cmath>
#include <cstdint>

namespace umbsim {
namespace {

constexpr double kUnits = 1e9;
constexpr int kDigits = 9;
constexpr double kFine = 9e6;       // above, 1e-9 is finer than a double
constexpr double kOrdinary = 4e6;   // up to here a double is at most one multiple of 1e-9
constexpr double kSmallest = 1e-4;  // below, fmt writes an exponent

char* write_any(char* text, double value) { return fmt::format_to(text, FMT_COMPILE("{}"), value); }

// A whole number of units, its fraction without zeros at the end.
char* write_units(char* text, std::uint64_t units) {
  const std::uint64_t whole = units / std::uint64_t(kUnits);
  std::uint32_t rest = std::uint32_t(units % std::uint64_t(kUnits));
  text = std::to_chars(text, text + kDecimalRoom - kDigits - 2, whole).ptr;
  if (rest == 0) return text;
  int digits = kDigits;
  for (; rest % 10 == 0; rest /= 10) --digits;
  *text = '.';
  for (int i = digits; i > 0; --i, rest /= 10) text[i] = char('0' + rest % 10);
  return text + digits + 1;
}

}  // namespace

char* write_decimal(char* text, double value) {
  const double size = std::abs(value);
  if (!(size <= kFine)) return write_any(text, value);
  const double units = std::round(size * kUnits);
  if (units == 0) return write_any(text, 0);
  if (size > kOrdinary || units < kSmallest * kUnits) return write_any(text, std::copysign(units / kUnits, value));
  if (value < 0) *text++ = '-';
  return write_units(text, std::uint64_t(units));
}

}  // namespace umbsim
