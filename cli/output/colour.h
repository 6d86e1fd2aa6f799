#pragma once

#include <string>

namespace umbsim {

/// A text for standard output or standard error: on a terminal that shows colours its labels stand out ("met", "NOT
/// MET", "Warning:", "umbsim:"); elsewhere it is as it was. Columns were counted before: colours take none.
std::string for_terminal(const std::string& text, int file_descriptor);

/// The same of --help: headings and names of commands and options are bold.
std::string help_for_terminal(const std::string& text);

/// Prints on standard output.
void print_words(const std::string& text);

/// "umbsim: TEXT" on standard error.
void print_error(const std::string& text);

}  // namespace umbsim
