#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace umbsim {

/// What the page of a score shows: of a trial (summary.json) or of the proving ground (worlds.json). `folder`: where
/// the score lies; each case is linked to its diagnosis beside it, where there is one. `version`: of the program.
nlohmann::ordered_json score_page(const nlohmann::ordered_json& score, const std::filesystem::path& folder,
                                  const std::string& version, const nlohmann::ordered_json& provenance);

}  // namespace umbsim
