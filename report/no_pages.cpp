// In the place of report.cpp where the program is built without pages.
#include "report/report.h"

namespace umbsim {

bool has_pages() { return false; }

std::string render_report(PageKind, const nlohmann::ordered_json&) { return ""; }

std::optional<nlohmann::ordered_json> page_data(const std::string&) { return std::nullopt; }

}  // namespace umbsim
