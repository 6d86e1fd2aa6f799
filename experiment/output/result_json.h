#pragma once

#include <nlohmann/json.hpp>

#include "experiment/explain/explain.h"
#include "experiment/run.h"

namespace umbsim {

using Json = nlohmann::ordered_json;

Json umbmark_json(const Umbmark& umbmark);
Json estimate_json(const ErrorEstimate& estimate);
/// Both forms, when to trust which, and whose corrections went into the odometry (none if not given).
Json calibration_json(const Umbmark& umbmark, std::optional<CalibrationMethod> applied);
Json cluster_json(const Cluster& cluster);

/// summary.json (format umbsim-result/1).
Json summary_json(const ExperimentResult& result);

/// What the report page is made from: the summary, and the runs with their paths thinned out.
Json report_json(const ExperimentResult& result);

/// explain.json (format umbsim-explanation/1).
Json explanation_json(const Scenario& scenario, const Explanation& explanation);
/// What the replay on its page shows: runs, robot, floor.
Json explained_runs_json(const Scenario& scenario, const Explanation& explanation);

/// provenance.json: version, commit, seed, compiler, Bullet version, host.
/// `input`: the file or folder that was read.
Json provenance_json(const std::string& input, std::uint64_t seed);
/// The same for a page, which may be passed on and is the same for the same result: without host and path.
Json page_provenance_json(const std::string& input, std::uint64_t seed);

}  // namespace umbsim
