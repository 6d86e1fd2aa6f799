#include "core/text/wrapped_text.h"

#include <algorithm>

namespace umbsim {
namespace {

bool begins_character(char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }

}  // namespace

std::size_t columns_of(const std::string& line) {
  return std::size_t(std::count_if(line.begin(), line.end(), begins_character));
}

std::string wrapped(const std::string& text, std::size_t indent) {
  std::string lines;
  std::string line;
  bool empty = true;  // but for its indent
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t begin = std::min(text.find_first_not_of(' ', at), text.size());
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    if (!empty && columns_of(line) + columns_of(text.substr(at, end - at)) > kColumns) {
      lines += line + "\n";
      line = std::string(indent, ' ');
      at = begin;
    }
    line += text.substr(at, end - at);
    empty = false;
    at = end;
  }
  return lines + line + "\n";
}

std::string wrapped_lines(const std::string& text, std::size_t indent) {
  std::string lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    lines += wrapped(text.substr(at, end - at), indent);
    at = end + 1;
  }
  return lines;
}

std::string fitted(const std::string& text, std::size_t columns) {
  const std::size_t all = columns_of(text);
  if (all <= columns) return text + std::string(columns - all, ' ');
  const std::size_t kept = columns - std::min<std::size_t>(columns, 3);
  std::size_t at = 0;
  for (std::size_t n = 0; at < text.size(); ++at) {
    if (begins_character(text[at]) && n++ == kept) break;
  }
  return text.substr(0, at) + std::string(columns - kept, '.');
}

}  // namespace umbsim
