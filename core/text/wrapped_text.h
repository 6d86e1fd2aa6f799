#pragma once

#include <cstddef>
#include <string>

namespace umbsim {

/// Columns of a terminal, into which everything fits that the program prints.
constexpr std::size_t kColumns = 80;

/// Columns that a line of UTF-8 takes: one a character.
std::size_t columns_of(const std::string& line);

/// One line of text as lines that fit, broken at spaces; all but the first begin with `indent` spaces. What has no
/// space in it, such as a path, is not broken. Ends with a new line.
std::string wrapped(const std::string& text, std::size_t indent = 2);

/// The same of every line of a text.
std::string wrapped_lines(const std::string& text, std::size_t indent = 2);

/// Text cut to fit a column, with "..." at its end, and filled with spaces up to it.
std::string fitted(const std::string& text, std::size_t columns);

}  // namespace umbsim
