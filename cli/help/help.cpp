#include "cli/help/help.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <regex>
#include <sstream>

#include "core/text/wrapped_text.h"

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

// Groups of options, in the order of --help; a command's own groups stand behind the first.
constexpr const char* kInput = "Input";
constexpr const char* kResult = "Result";
constexpr const char* kWork = "Work";
constexpr const char* kHelp = "Help";

// Options that mean the same wherever they are; all others are input.
const char* group_of(const std::string& name) {
  static const std::map<std::string, const char*> groups{
      {"help", kHelp},     {"version", kHelp},   {"out", kResult},        {"force", kResult},   {"open", kResult},
      {"junit", kResult},  {"json", kResult},    {"quiet", kResult},      {"dry-run", kResult}, {"picture", kResult},
      {"format", kResult}, {"columns", kResult}, {"where", kResult},      {"matrix", kResult},  {"to", kResult},
      {"jobs", kWork},     {"shard", kWork},     {"retry-failed", kWork}, {"retry", kWork},     {"no-cache", kWork},
      {"cache", kWork},    {"program", kWork},   {"draws", kWork},        {"seed", kWork}};
  const auto found = groups.find(name);
  return found == groups.end() ? kInput : found->second;
}

int place_of_group(const std::string& group) {
  const std::array<const char*, 3> last{kResult, kWork, kHelp};
  const auto found = std::find(last.begin(), last.end(), group);
  return found != last.end() ? 2 + int(found - last.begin()) : group == kInput ? 0 : 1;
}

}  // namespace

void group_options(CLI::App& app) {
  for (CLI::Option* option : app.get_options()) {
    const bool grouped = option->get_group() != "Options";
    if (!grouped && !option->get_lnames().empty()) option->group(group_of(option->get_lnames().front()));
  }
  for (CLI::App* command : app.get_subcommands(nullptr)) group_options(*command);
}

std::string HelpFormatter::make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const {
  if (mode == CLI::AppFormatMode::Sub) return make_expanded(app);
  std::string text = make_description(app) + make_usage(app, std::move(name)) + make_positionals(app);
  std::vector<std::string> groups = app->get_groups();
  std::stable_sort(groups.begin(), groups.end(),
                   [](const auto& a, const auto& b) { return place_of_group(a) < place_of_group(b); });
  for (const std::string& group : groups) {
    const auto options =
        app->get_options([&](const CLI::Option* o) { return o->get_group() == group && o->nonpositional(); });
    if (!group.empty() && !options.empty()) text += make_group(group, false, options);
  }
  return text + make_subcommands(app, mode) + "\n" + make_footer(app);
}

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
  // "INT:INT in [0 - 8] Excludes: --json" as "INT in [0 - 8]".
  static const std::regex twice("(INT|FLOAT):\\1 in"), excludes(" Excludes:.*");
  const std::string opts = std::regex_replace(make_option_opts(option), twice, "$1 in");
  return two_columns(make_option_name(option, is_positional) + std::regex_replace(opts, excludes, ""),
                     make_option_desc(option));
}

std::string HelpFormatter::make_subcommand(const CLI::App* command) const {
  return two_columns(command->get_name(), command->get_description());
}

void add_example(CLI::App* command, const std::string& example) { command->footer("Example:\n  " + example); }

}  // namespace umbsim
