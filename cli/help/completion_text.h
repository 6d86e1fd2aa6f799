#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace umbsim {

/// Completion for bash and zsh, and a manual page: all that the tables of commands and options say.
std::string bash_completion(const CLI::App& app);
std::string zsh_completion(const CLI::App& app);
std::string manual_page(const CLI::App& app, const std::string& version);

}  // namespace umbsim
