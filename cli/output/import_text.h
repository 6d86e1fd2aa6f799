#pragma once

#include <string>

#include "exchange/import/imported.h"
#include "experiment/output/result_json.h"

namespace umbsim {

/// What was found in a source and how it was cut, for the terminal.
std::string import_text(const exchange::Imported& imported);

/// import.json (format umbsim-import/1).
Json import_json(const exchange::Imported& imported);

}  // namespace umbsim
