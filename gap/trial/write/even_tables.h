#pragma once

#include <filesystem>

#include "recording/recording.h"

namespace umbsim {

/// Writes encoders.csv and truth.csv of every run again, into a recording's folder, with the same values to 1e-9 but
/// every number of a column as wide as the next: zeros fill up. So the size of a file tells its number of rows and
/// nothing else; shortest numbers would tell how many are near zero.
void write_even_tables(const Recording& recording, const std::filesystem::path& directory);

}  // namespace umbsim
