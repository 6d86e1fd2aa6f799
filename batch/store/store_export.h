#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "batch/store/store.h"

namespace umbsim {

struct ExportChoice {
  bool json = false;                    ///< else CSV
  std::vector<std::string> columns;     ///< empty: all that hold anything
  std::vector<Condition> where;         ///< all must hold
  std::filesystem::path file;           ///< empty: standard output
};

/// Writes the rows of the view `results` in the order of the points. A file is written whole or not at all. Returns the
/// number of rows. Throws InputError for a column that is not there.
std::int64_t export_store(Store& store, const ExportChoice& choice);

}  // namespace umbsim
