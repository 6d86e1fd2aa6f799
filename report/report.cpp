#include "report/report.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "report/web_files.h"

namespace umbsim {
namespace {

using Json = nlohmann::ordered_json;
using Replacement = std::pair<std::string_view, std::string_view>;

constexpr std::string_view kDataBegin = R"(<script type="application/json" id="report-data">)";
constexpr std::string_view kDataEnd = "</script>";

// Kinds in the order of PageKind; some of what they show moves.
struct Kind {
  const char* name;
  bool replay;
};
constexpr Kind kKinds[] = {{"run", true},         {"recording", true},    {"sweep", false}, {"gap", true},
                           {"calibration", false}, {"explanation", true}, {"plan", false},  {"prediction", false},
                           {"score", false},       {"index", false}};

// Where several begin at one place, the first counts.
template <std::size_t N>
std::string replace_all(std::string_view text, const std::array<Replacement, N>& replacements) {
  std::array<std::size_t, N> next;  // place of each
  for (std::size_t i = 0; i < N; ++i) next[i] = text.find(replacements[i].first);
  std::string result;
  result.reserve(text.size());
  for (std::size_t at = 0;;) {
    const auto first = std::min_element(next.begin(), next.end());
    result += text.substr(at, *first - at);
    if (*first == std::string_view::npos) return result;
    const Replacement& r = replacements[std::size_t(first - next.begin())];
    result += r.second;
    at = *first + r.first.size();
    for (std::size_t i = 0; i < N; ++i) {
      if (next[i] < at) next[i] = text.find(replacements[i].first, at);
    }
  }
}

/// In JSON these occur only inside strings, where the escape means the same. No "<" is left: no "</script", no "<!--".
/// U+2028 and U+2029 end a line in older JavaScript.
std::string script_json(const Json& data) {
  const std::string text = data.dump(-1, ' ', false, Json::error_handler_t::replace);
  return replace_all(
      text, std::array<Replacement, 3>{{{"<", "\\u003c"}, {"\xE2\x80\xA8", "\\u2028"}, {"\xE2\x80\xA9", "\\u2029"}}});
}

std::string html_text(std::string_view text) {
  return replace_all(text, std::array<Replacement, 3>{{{"&", "&amp;"}, {"<", "&lt;"}, {">", "&gt;"}}});
}

std::string title_of(const Json& data) {
  const auto title = data.find("title");
  return title != data.end() && title->is_string() ? title->get<std::string>() : "umbsim";
}

}  // namespace

bool has_pages() { return true; }

std::string render_report(PageKind kind, const Json& data) {
  if (!data.is_object()) throw std::invalid_argument("render_report: data must be a JSON object");
  const Kind& k = kKinds[std::size_t(kind)];
  Json shown{{"page", k.name}};
  shown.update(data);
  shown["page"] = k.name;
  const std::string title = html_text(title_of(data));
  const std::string json = script_json(shown);
  return replace_all(web::page_html,
                     std::array<Replacement, 3>{{{"@TITLE@", title},
                                                 {"@DATA@", json},
                                                 {"@REPLAY@", k.replay ? web::replay_js : std::string_view()}}});
}

std::optional<Json> page_data(const std::string& page) {
  const std::size_t at = page.find(kDataBegin);
  if (at == std::string::npos) return std::nullopt;
  const std::size_t begin = at + kDataBegin.size();
  const std::size_t end = page.find(kDataEnd, begin);
  if (end == std::string::npos) return std::nullopt;
  Json data = Json::parse(page.begin() + std::ptrdiff_t(begin), page.begin() + std::ptrdiff_t(end), nullptr, false);
  if (!data.is_object() || !data.contains("page")) return std::nullopt;
  return data;
}

}  // namespace umbsim
