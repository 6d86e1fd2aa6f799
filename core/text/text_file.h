#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace umbsim {

/// The whole content of a file. Throws InputError naming the file if it is missing, a directory, unreadable or
/// longer than `max_bytes`.
std::string read_text_file(const std::filesystem::path& file, std::size_t max_bytes);

/// Replaces the content of a file. Throws RunError naming the file if it cannot be written completely.
void write_text_file(const std::filesystem::path& file, std::string_view text);

/// The same, whole or not at all: written beside the file first, then renamed.
void replace_text_file(const std::filesystem::path& file, std::string_view text);

}  // namespace umbsim
