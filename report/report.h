#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace umbsim {

/// One self-contained HTML page that opens offline. `data` holds title, description, version, seed, summary
/// (summary.json), runs (return error, decimated truth and odometry paths in metres and radians) and bumps; every part
/// may be missing: the page then leaves that section out. Optional `side_m` and `wheelbase_m` (nominal) add R and the
/// actual wheelbase.
std::string render_report(const nlohmann::json& data);

/// The same for a sweep: `data` holds title, description, version, points, done, failed, checks, axes, figures, view,
/// stride and rows (experiment/sweep_result.h).
std::string render_sweep_report(const nlohmann::json& data);

/// The same for a gap diagnosis: `data` holds title, version, diagnosis (diagnosis.json without its cost) and runs
/// (gap/output/tracks_json.h).
std::string render_gap_report(const nlohmann::json& data);

}  // namespace umbsim
