#pragma once

#include <string>
#include <vector>

#include "exchange/import/options.h"
#include "exchange/text/columns.h"

namespace umbsim::exchange {

/// The tracked poses of a table with named columns: x, y and a heading, or a position and a quaternion. Of several
/// groups (topics) --truth says which. What was understood goes to `found`. Throws InputError.
Track track_of_columns(const Columns& columns, std::size_t time, std::int64_t time_ns, const ImportOptions& options,
                       std::vector<std::string>& found);

/// Whether a topic's or column's name is that of the robot's own odometry, which is no truth.
bool sounds_like_odometry(const std::string& name);

}  // namespace umbsim::exchange
