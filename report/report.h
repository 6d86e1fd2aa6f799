#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace umbsim {

/// One self-contained HTML page that opens offline. `data` holds title, description, version, seed, summary
/// (summary.json), runs (return error, decimated truth and odometry paths in metres and radians) and bumps; every part
/// may be missing: the page then leaves that section out. Optional `side_m` and `wheelbase_m` (nominal) add R and the
/// actual wheelbase.
std::string render_report(const nlohmann::json& data);

}  // namespace umbsim
