#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace umbsim {

/// `text` on one line of at most `width` columns, cut between words.
std::string shortened(const std::string& text, std::size_t width);

/// --help within 80 columns: what goes in, what comes out, how the work is done.
class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
  std::string make_description(const CLI::App* app) const override;
  std::string make_option(const CLI::Option* option, bool is_positional) const override;
  std::string make_subcommand(const CLI::App* command) const override;
};

/// Shows `example` at the end of the command's --help.
void add_example(CLI::App* command, const std::string& example);

/// Sorts the options of every command into groups: what goes in, what comes out, how the work is done.
void group_options(CLI::App& app);

/// What `umbsim` alone shows: what most people want.
std::string start_text();

/// `help gap diagnose` and `gap help diagnose` as `gap diagnose --help`.
std::vector<std::string> with_help_option(const CLI::App& app, const std::vector<std::string>& words);

/// What is wrong with words that the parser refused, what was probably meant, and where to read on.
std::string usage_error(const CLI::App& app, const std::vector<std::string>& words, const CLI::ParseError& error);

}  // namespace umbsim
