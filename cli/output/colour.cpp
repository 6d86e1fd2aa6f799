#include "cli/output/colour.h"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <sstream>

#include "core/terminal.h"
#include "core/text/printable.h"

namespace umbsim {
namespace {

constexpr const char* kBold = "\033[1m";
constexpr const char* kRed = "\033[1;31m";
constexpr const char* kGreen = "\033[32m";
constexpr const char* kYellow = "\033[33m";
constexpr const char* kPlain = "\033[0m";

struct Label {
  const char* text;  ///< at the beginning of a line, behind spaces
  const char* colour;
};
constexpr std::array<Label, 7> kLabels{{{"met ", kGreen},
                                        {"NOT MET", kRed},
                                        {"Warning:", kYellow},
                                        {"Limit:", kYellow},
                                        {"Result in ", kBold},
                                        {"umbsim: warning:", kYellow},
                                        {"umbsim:", kRed}}};

std::string highlighted(const std::string& text, std::size_t from, std::size_t size, const char* colour) {
  return text.substr(0, from) + colour + text.substr(from, size) + kPlain + text.substr(from + size);
}

std::string labelled(const std::string& line) {
  const std::size_t begin = line.find_first_not_of(' ');
  if (begin == std::string::npos) return line;
  for (const Label& l : kLabels) {
    const std::string label = l.text;
    if (line.compare(begin, label.size(), label) == 0) return highlighted(line, begin, label.size(), l.colour);
  }
  return line;
}

// A heading ("Options:"), or a name with what it is for two or more spaces behind it or on the next line.
std::string help_line(const std::string& line) {
  if (line.empty()) return line;
  if (line.front() != ' ') return line.back() == ':' ? highlighted(line, 0, line.size(), kBold) : line;
  if (line.size() < 3 || line.compare(0, 2, "  ") != 0 || line[2] == ' ') return line;
  return highlighted(line, 2, line.find(' ', 2) == std::string::npos ? line.size() - 2 : line.find(' ', 2) - 2, kBold);
}

template <class Line>
std::string each_line(const std::string& text, const Line& change) {
  std::istringstream lines(text);
  std::string changed;
  for (std::string line; std::getline(lines, line);) changed += change(line) + (lines.eof() ? "" : "\n");
  return changed;
}

}  // namespace

std::string for_terminal(const std::string& text, int file_descriptor) {
  return shows_colour(file_descriptor) ? each_line(text, labelled) : text;
}

std::string help_for_terminal(const std::string& text) {
  return shows_colour(STDOUT_FILENO) ? each_line(text, help_line) : text;
}

void print_words(const std::string& text) { fmt::print("{}", for_terminal(text, STDOUT_FILENO)); }

void print_error(const std::string& text) {
  fmt::print(stderr, "{}\n", for_terminal("umbsim: " + printable(text), STDERR_FILENO));
}

}  // namespace umbsim
