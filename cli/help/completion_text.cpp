#include "cli/help/completion_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <functional>
#include <sstream>
#include <vector>

namespace umbsim {
namespace {

using Commands = std::vector<const CLI::App*>;

Commands below(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* a) { return !a->get_group().empty(); });
}

// Every command with the words that lead to it, "" for the program itself.
void each_command(const CLI::App& app, const std::string& path,
                  const std::function<void(const CLI::App&, const std::string&)>& take) {
  take(app, path);
  for (const CLI::App* command : below(app)) {
    each_command(*command, path + (path.empty() ? "" : " ") + command->get_name(), take);
  }
}

std::vector<std::string> options_of(const CLI::App& app) {
  std::vector<std::string> words;
  for (const CLI::Option* option : app.get_options([](const CLI::Option* o) { return o->nonpositional(); })) {
    for (const std::string& name : option->get_lnames()) words.push_back("--" + name);
  }
  return words;
}

// The words that an option takes, where they are a set: CLI11 names its type "TEXT:{a,b}".
std::string choices_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t from = type.find('{'), to = type.rfind('}');
  if (from == type.npos || to == type.npos) return "";
  std::string words = type.substr(from + 1, to - from - 1);
  for (char& c : words) c = c == ',' ? ' ' : c;
  return words;
}

// `"run") WHAT ;;` for each command; `what` gets the command.
std::string cases(const CLI::App& app, const std::function<std::string(const CLI::App&)>& what) {
  std::string text;
  each_command(app, "", [&](const CLI::App& command, const std::string& path) {
    const std::string done = what(command);
    if (!done.empty()) text += fmt::format("    \"{}\") {} ;;\n", path, done);
  });
  return text;
}

std::string choice_cases(const CLI::App& app) {
  std::string text;
  each_command(app, "", [&](const CLI::App& command, const std::string& path) {
    for (const CLI::Option* option : command.get_options()) {
      const std::string choices = choices_of(*option);
      if (choices.empty() || option->get_lnames().empty()) continue;
      text += fmt::format("    \"{} --{}\") choices=\"{}\" ;;\n", path, option->get_lnames()[0], choices);
    }
  });
  return text;
}

std::string path_patterns(const CLI::App& app) {
  std::vector<std::string> paths;
  each_command(app, "", [&](const CLI::App&, const std::string& path) {
    const std::size_t cut = path.rfind(' ');
    const std::string before = cut == path.npos ? "" : path.substr(0, cut);
    if (!path.empty()) paths.push_back(fmt::format("\"{} {}\"", before, path.substr(cut == path.npos ? 0 : cut + 1)));
  });
  return fmt::format("{}", fmt::join(paths, "|"));
}

// For both shells: walks the words before the cursor to the command that they name, and to the choices of the option
// that stands last. `words`: the array; `first`: behind the program's name; `cursor`: index of the word in work.
std::string walk_text(const CLI::App& app, const char* words, int first, const char* cursor) {
  return fmt::format(
      "  for ((i = {1}; i < {2}; ++i)); do\n"
      "    case \"$command ${{{0}[i]}}\" in\n"
      "      {3}) command=\"${{command:+$command }}${{{0}[i]}}\" ;;\n"
      "    esac\n"
      "  done\n"
      "  case \"$command ${{{0}[{2}-1]}}\" in\n{4}  esac\n",
      words, first, cursor, path_patterns(app), choice_cases(app));
}

std::string quoted(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '\'' ? "'\\''" : c == ':' ? "\\:" : std::string(1, c);
  return "'" + out + "'";
}

std::string roff(const std::string& text) {
  std::string out;
  bool begins = true;
  for (const char c : text) {
    if (begins && (c == '.' || c == '\'')) out += "\\&";
    out += c == '\\' ? "\\\\" : c == '-' ? "\\-" : std::string(1, c);
    begins = c == '\n';
  }
  return out;
}

}  // namespace

std::string bash_completion(const CLI::App& app) {
  return fmt::format(
      "# Completion of umbsim for bash, made by `umbsim completion bash`.\n"
      "_umbsim() {{\n"
      "  local word=${{COMP_WORDS[COMP_CWORD]}} command=\"\" options=\"\" "
      "choices=\"\" i\n"
      "{}"
      "  case \"$command\" in\n{}  esac\n"
      "  mapfile -t COMPREPLY < <(compgen -W \"${{choices:-$options}}\" -- \"$word\")\n"
      "}}\n"
      "complete -o default -F _umbsim umbsim ./umbsim\n",
      walk_text(app, "COMP_WORDS", 1, "COMP_CWORD"), cases(app, [](const CLI::App& command) {
        std::vector<std::string> words;
        for (const CLI::App* c : below(command)) words.push_back(c->get_name());
        for (const std::string& option : options_of(command)) words.push_back(option);
        return fmt::format("options=\"{}\"", fmt::join(words, " "));
      }));
}

std::string zsh_completion(const CLI::App& app) {
  return fmt::format(
      "#compdef umbsim\n"
      "# Completion of umbsim for zsh, made by `umbsim completion zsh`.\n"
      "local command=\"\" choices=\"\" i\n"
      "local -a offered\n"
      "{}"
      "if [[ -n \"$choices\" ]]; then\n"
      "  offered=(${{=choices}})\n"
      "  _describe 'value' offered\n"
      "  return\n"
      "fi\n"
      "case \"$command\" in\n{}esac\n"
      "_describe 'umbsim' offered\n"
      "_files\n",
      walk_text(app, "words", 2, "CURRENT"), cases(app, [](const CLI::App& command) {
        std::vector<std::string> words;
        for (const CLI::App* c : below(command))
          words.push_back(quoted(c->get_name()) + ":" + quoted(c->get_description()));
        for (const CLI::Option* option : command.get_options([](const CLI::Option* o) { return o->nonpositional(); })) {
          for (const std::string& name : option->get_lnames()) {
            words.push_back(quoted("--" + name) + ":" + quoted(option->get_description()));
          }
        }
        return fmt::format("offered=({})", fmt::join(words, " "));
      }));
}

std::string manual_page(const CLI::App& app, const std::string& version) {
  std::string text = fmt::format(
      ".\\\" Made by `umbsim completion man`.\n.TH UMBSIM 1 \"\" \"umbsim {}\" \"User Commands\"\n"
      ".SH NAME\numbsim \\- physics testbed for honest odometry\n",
      roff(version));
  each_command(app, "", [&](const CLI::App& command, const std::string& path) {
    // By the formatter: help() would show the command that is being run.
    const std::string help = command.get_formatter()->make_help(&command, path.empty() ? "umbsim" : "umbsim " + path,
                                                                CLI::AppFormatMode::Normal);
    text += fmt::format(".SH {}\n.nf\n{}\n.fi\n", path.empty() ? "SYNOPSIS" : roff("umbsim " + path), roff(help));
  });
  return text;
}

}  // namespace umbsim
