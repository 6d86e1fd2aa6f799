#pragma once

#include <filesystem>
#include <string>

namespace umbsim {

/// What comes with the program: `name` is robots or scenarios. Of an installed program below its prefix
/// (share/umbsim/<name>), else of the source that it was built from.
std::filesystem::path data_folder(const std::string& name);

}  // namespace umbsim
