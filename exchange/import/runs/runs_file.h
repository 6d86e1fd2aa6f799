#pragma once

#include <string>
#include <vector>

#include "exchange/import/runs/cut.h"

namespace umbsim::exchange {

/// A CSV file with the columns id, from_s, to_s and maybe direction (cw | ccw | free): seconds since the log's first
/// row. Throws InputError: other columns, an id twice, times that run back or overlap.
std::vector<Piece> read_runs_file(const std::string& file);

}  // namespace umbsim::exchange
