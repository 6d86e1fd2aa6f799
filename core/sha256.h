#pragma once

#include <string>
#include <string_view>

namespace umbsim {

/// SHA-256 of the bytes, as 64 hexadecimal digits. Throws RunError if OpenSSL cannot compute it.
std::string sha256(std::string_view bytes);

}  // namespace umbsim
