#include "core/text/printable.h"

#include <fmt/format.h>

namespace umbsim {

std::string printable(const std::string& text) {
  constexpr std::size_t kFirst = 2000, kLast = 1000;
  if (text.size() > kFirst + kLast) {
    return printable(text.substr(0, kFirst)) + " ... " + printable(text.substr(text.size() - kLast));
  }
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte < 0x20 && c != '\n') || byte == 0x7f) {
      out += fmt::format("\\x{:02x}", byte);
    } else {
      out += c;
    }
  }
  return out;
}

}  // namespace umbsim
