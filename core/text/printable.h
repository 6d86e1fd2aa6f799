#pragma once

#include <string>

namespace umbsim {

/// For a terminal: control characters but line breaks as \xNN, so that no file can move the cursor, and of a
/// very long text its beginning and its end.
std::string printable(const std::string& text);

}  // namespace umbsim
