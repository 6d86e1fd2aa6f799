#include "report/score_page.h"

namespace umbsim {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// Verdicts are a list with names (trial) or named entries (proving ground).
Json case_links(const Json& verdicts, const fs::path& folder) {
  Json links = Json::object();
  for (const auto& [key, verdict] : verdicts.items()) {
    const std::string name = verdict.value("name", key);
    for (const char* file : {"report.html", "diagnosis.json"}) {
      if (!fs::exists(folder / ".." / "diagnoses" / name / file)) continue;
      links[name] = (fs::path("..") / "diagnoses" / name / file).string();
      break;
    }
  }
  return links;
}

}  // namespace

Json score_page(const Json& score, const fs::path& folder, const std::string& version, const Json& provenance) {
  const bool worlds = score.contains("name");
  const std::string title = worlds ? "Worlds " + score.value("name", "") : "Trial " + score.value("trial", "");
  Json page{{"title", title}, {"version", version}, {"score", score}, {"provenance", provenance}};
  page["links"] = case_links(score.value("verdicts", Json::array()), folder);
  return page;
}

}  // namespace umbsim
