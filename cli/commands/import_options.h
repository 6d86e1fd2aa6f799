#pragma once

#include <CLI/CLI.hpp>

#include "exchange/import/options.h"

namespace umbsim {

/// The options that say what a source does not tell.
void add_import_options(CLI::App& command, exchange::ImportOptions& options);

}  // namespace umbsim
