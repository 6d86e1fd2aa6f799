#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace umbsim {

/// What a page shows; report/web/src/main.ts has a part for each.
enum class PageKind { run, recording, sweep, gap, calibration, explanation, plan, prediction, score, index };

/// False in a program that was built without pages (UMBSIM_PAGES=OFF): render_report() then gives an empty text.
bool has_pages();

/// One self-contained HTML page that opens offline. `data` is what the page shows, an object, with at least `title` and
/// `version`; every other part may be missing: the page then leaves it out.
std::string render_report(PageKind kind, const nlohmann::ordered_json& data);

/// The data of a page that render_report() made, with its `page` (the kind); none if the text is no such page.
std::optional<nlohmann::ordered_json> page_data(const std::string& page);

}  // namespace umbsim
