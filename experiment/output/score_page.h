#pragma once

#include <filesystem>

#include "experiment/output/result_json.h"

namespace umbsim {

/// What the page of a score shows: of a trial (summary.json) or of the proving ground (worlds.json). `folder`: where
/// the score lies; each case is linked to its diagnosis beside it, where there is one. `provenance`:
/// page_provenance_json().
Json score_page(const Json& score, const std::filesystem::path& folder, const Json& provenance);

}  // namespace umbsim
