#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "cli/help/help.h"
#include "core/text/choices.h"
#include "core/text/yaml_reader.h"

namespace umbsim {
namespace {

using Words = std::vector<std::string>;

bool is_option(const std::string& word) { return word.size() > 1 && word.front() == '-'; }

const CLI::App* find_subcommand(const CLI::App& command, const std::string& name) {
  for (const CLI::App* sub : command.get_subcommands(nullptr)) {
    if (sub->get_name() == name) return sub;
  }
  return nullptr;
}

Words subcommands(const CLI::App& command) {
  Words names;
  for (const CLI::App* sub : command.get_subcommands(nullptr)) names.push_back(sub->get_name());
  return names;
}

bool takes_words(const CLI::App& command) {
  return !command.get_options([](const CLI::Option* o) { return o->get_positional(); }).empty();
}

Words options(const CLI::App& command) {
  Words names;
  for (const CLI::Option* o : command.get_options(nullptr)) {
    for (const std::string& name : o->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

/// The deepest subcommand that words name, by which words, and the first word behind them, "" where there is none.
struct Place {
  const CLI::App* command;
  std::string path;
  std::string next;
};

Place place_of(const CLI::App& app, const Words& words) {
  Place place{&app, app.get_name(), ""};
  for (const std::string& word : words) {
    const CLI::App* sub = find_subcommand(*place.command, word);
    if (!sub) {
      place.next = word;
      break;
    }
    place.command = sub;
    place.path += " " + word;
  }
  return place;
}

// A subcommand that does not exist, where one is expected or nearly one was written.
std::string wrong_subcommand(const CLI::App& app, const Place& place) {
  const Words known = subcommands(*place.command);
  if (known.empty() || place.next.empty() || is_option(place.next)) return "";
  if (takes_words(*place.command) && !nearest(place.next, known)) return "";
  const std::string whose = place.command == &app ? "" : fmt::format(" of `{}`", place.path);
  return fmt::format("unknown subcommand '{}'{}; {}", place.next, whose, list_choices(place.next, known));
}

// The first word that the parser did not know what to do with.
std::string wrong_word(const CLI::App& app, const Place& place) {
  Words extra = app.remaining(true);
  extra.erase(std::remove(extra.begin(), extra.end(), "--"), extra.end());
  if (extra.empty()) return "";
  const std::string word = extra.front().substr(0, extra.front().find('='));
  if (!is_option(word)) return fmt::format("'{}': `{}` has no use for this word", extra.front(), place.path);
  return fmt::format("unknown option '{}' of `{}`; {}", word, place.path, did_you_mean(word, options(*place.command)));
}

}  // namespace

Words with_help_option(const CLI::App& app, const Words& words) {
  const CLI::App* command = &app;
  Words path;
  bool help = false;
  std::string next;
  for (const std::string& word : words) {
    const CLI::App* sub = find_subcommand(*command, word);
    if (sub) {
      command = sub;
      path.push_back(word);
    } else if (word == "help" && !std::filesystem::exists(word)) {
      help = true;
    } else {
      next = word;
      break;
    }
  }
  if (!help) return words;
  // A subcommand that does not exist is an error; what a command would be about does not matter.
  const bool wrong = !next.empty() && !subcommands(*command).empty() && !takes_words(*command);
  path.push_back(wrong ? next : "--help");
  return path;
}

std::string usage_error(const CLI::App& app, const Words& words, const CLI::ParseError& error) {
  const Place place = place_of(app, words);
  std::string what = wrong_subcommand(app, place);
  if (what.empty()) what = wrong_word(app, place);
  if (what.empty()) what = error.what();
  while (!what.empty() && what.back() == ' ') what.pop_back();
  return fmt::format("{}\n`{} --help` shows how it is used", what, place.path);
}

}  // namespace umbsim
