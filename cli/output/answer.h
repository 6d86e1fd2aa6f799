#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <string>

namespace umbsim {

/// How a command answers on standard output: in words, as JSON, or not at all.
struct Answer {
  bool quiet = false;
  bool json = false;
  /// Whether the result goes into a folder: for whoever asks for JSON, only if --out names one.
  bool wants_folder(const std::string& out) const { return !json || !out.empty(); }
};

/// --quiet and --json. `file`: of a result folder, whose content --json prints.
void add_answer_options(CLI::App* command, Answer& answer, const std::string& file);

/// `words` or `json`, as the command was asked to.
void print_answer(const Answer& answer, const std::string& words, const nlohmann::ordered_json& json);

}  // namespace umbsim
