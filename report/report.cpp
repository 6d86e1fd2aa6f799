#include "report/report.h"

#include <array>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "report/web_files.h"

namespace umbsim {
namespace {

using Replacement = std::pair<std::string_view, std::string_view>;

template <std::size_t N>
std::string replace_all(std::string_view text, const std::array<Replacement, N>& replacements) {
  std::string result;
  result.reserve(text.size());
  for (std::size_t at = 0; at < text.size();) {
    const Replacement* hit = nullptr;
    for (const Replacement& r : replacements) {
      if (text.compare(at, r.first.size(), r.first) == 0) {
        hit = &r;
        break;
      }
    }
    result += hit ? hit->second : text.substr(at, 1);
    at += hit ? hit->first.size() : 1;
  }
  return result;
}

/// In JSON these occur only inside strings, where the escape means the same. No "<" is left: no "</script", no "<!--".
/// U+2028 and U+2029 end a line in older JavaScript.
std::string script_json(const nlohmann::json& data) {
  const std::string text = data.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  return replace_all(
      text, std::array<Replacement, 3>{{{"<", "\\u003c"}, {"\xE2\x80\xA8", "\\u2028"}, {"\xE2\x80\xA9", "\\u2029"}}});
}

std::string html_text(std::string_view text) {
  return replace_all(text, std::array<Replacement, 3>{{{"&", "&amp;"}, {"<", "&lt;"}, {">", "&gt;"}}});
}

std::string title_of(const nlohmann::json& data) {
  const auto title = data.find("title");
  return title != data.end() && title->is_string() ? title->get<std::string>() : "UMBmark report";
}

std::string page_of(const nlohmann::json& data, std::string_view script) {
  if (!data.is_object()) throw std::invalid_argument("render_report: data must be a JSON object");
  const std::string title = html_text(title_of(data));
  const std::string json = script_json(data);
  return replace_all(
      web::page_html,
      std::array<Replacement, 4>{
          {{"@TITLE@", title}, {"@STYLE@", web::report_css}, {"@DATA@", json}, {"@SCRIPT@", script}}});
}

}  // namespace

std::string render_report(const nlohmann::json& data) { return page_of(data, web::report_js); }

std::string render_sweep_report(const nlohmann::json& data) { return page_of(data, web::sweep_js); }

std::string render_gap_report(const nlohmann::json& data) { return page_of(data, web::gap_js); }

}  // namespace umbsim
