#pragma once

#include <string>

namespace umbsim {

/// Deepest nesting of maps and lists in a document.
constexpr int kMaxYamlDepth = 64;
/// Keys, values, maps and lists in a file: a sweep's list of 75,000 points of two numbers.
constexpr int kMaxYamlNodes = 300'000;

/// Throws InputError with file:line:column for what yaml-cpp would accept in silence or not survive: an empty document,
/// a second document, duplicate keys, keys that are not plain text, aliases, control characters, nesting deeper than
/// kMaxYamlDepth. A YAML syntax error becomes an InputError as well.
void check_yaml(const std::string& text, const std::string& file);

}  // namespace umbsim
