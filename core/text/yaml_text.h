#pragma once

#include <string>

namespace umbsim {

/// A number as YAML text: the shortest that reads back as the same double, with the point that YAML 1.1 readers want
/// before an exponent. Throws RunError naming `key` if it is not finite.
std::string yaml_number(double value, const char* key);

/// A string as YAML text, quoted wherever a plain one could be read as something else, inside a flow map too.
std::string yaml_string(const std::string& text);

}  // namespace umbsim
