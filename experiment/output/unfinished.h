#pragma once

#include <filesystem>

namespace umbsim {

/// Where a result is made before it gets its place: beside `folder`, with this machine's and this process's name, and
/// `.part` (what grows) or `.old` (what it replaces).
std::filesystem::path beside(const std::filesystem::path& folder, const char* kind);

/// What processes of this machine that are no more left beside `folder`: what had not been finished is removed, a result
/// that was about to be replaced is put back. Says on standard error what it found.
void tidy_up(const std::filesystem::path& folder);

/// Puts `made` in the place of `folder`, in one step where the file system can exchange them: at no moment is there
/// neither the old result nor the new one. Then removes the old one.
void replace_folder(const std::filesystem::path& made, const std::filesystem::path& folder, std::error_code& error);

}  // namespace umbsim
