#include "cli/help.h"

#include <algorithm>
#include <cctype>
#include <sstream>

#include "core/wrapped_text.h"

namespace umbsim {
namespace {

constexpr std::size_t kLeftColumn = 28;

// A name and what it is for, in two columns.
std::string two_columns(const std::string& left, const std::string& right) {
  std::string text = "  " + left;
  if (right.empty()) return text + "\n";
  if (text.size() + 1 > kLeftColumn) text += "\n";
  const std::size_t column = text.back() == '\n' ? 0 : text.size();
  text.append(kLeftColumn - column, ' ');
  return text + wrapped(std::string(kLeftColumn, ' ') + right, kLeftColumn).substr(kLeftColumn);
}

}  // namespace

std::string shortened(const std::string& text, std::size_t width) {
  constexpr const char* kMore = "...";
  std::istringstream words(text);
  std::string line, shorter;
  for (std::string word; words >> word;) {
    line += (line.empty() ? "" : " ") + word;
    if (line.size() + 3 <= width) shorter = line;
  }
  if (line.size() <= width) return line;
  while (!shorter.empty() && std::ispunct(static_cast<unsigned char>(shorter.back()))) shorter.pop_back();
  return shorter + kMore;
}

std::string HelpFormatter::make_description(const CLI::App* app) const {
  return wrapped_lines(app->get_description(), 0) + "\n";
}

std::string HelpFormatter::make_option(const CLI::Option* option, bool is_positional) const {
  return two_columns(make_option_name(option, is_positional) + make_option_opts(option), make_option_desc(option));
}

std::string HelpFormatter::make_subcommand(const CLI::App* command) const {
  return two_columns(command->get_name(), command->get_description());
}

void add_example(CLI::App* command, const std::string& example) { command->footer("Example:\n  " + example); }

}  // namespace umbsim
