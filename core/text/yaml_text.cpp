#include "core/text/yaml_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "core/error.h"

namespace umbsim {
namespace {

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_harmless(char c) {
  return is_letter(c) || (c >= '0' && c <= '9') || std::string_view(" ._/()+;=-").find(c) != std::string_view::npos;
}

// Words that some YAML version reads as a null, a truth value or a number.
bool is_reserved(const std::string& text) {
  constexpr std::array<std::string_view, 11> kWords = {"null", "true", "false", "yes", "no", "on",
                                                       "off",  "y",    "n",     "nan", "inf"};
  std::string lower;
  for (const char c : text) lower += char(std::tolower(static_cast<unsigned char>(c)));
  return std::find(kWords.begin(), kWords.end(), lower) != kWords.end();
}

}  // namespace

std::string yaml_number(double value, const char* key) {
  if (!std::isfinite(value)) throw RunError(fmt::format("recording.yaml: {}: {} is not a finite number", key, value));
  std::string text = fmt::format("{}", value);
  const std::size_t exponent = text.find('e');
  if (exponent != std::string::npos && text.find('.') == std::string::npos) text.insert(exponent, ".0");
  return text;
}

std::string yaml_string(const std::string& text) {
  const bool plain = !text.empty() && is_letter(text.front()) && text.back() != ' ' && !is_reserved(text) &&
                     std::all_of(text.begin(), text.end(), is_harmless);
  if (plain) return text;
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f) {
      out += fmt::format("\\x{:02x}", byte);
    } else {
      if (c == '"' || c == '\\') out += '\\';
      out += c;
    }
  }
  return out + '"';
}

}  // namespace umbsim
