#include "cli/output/index_page.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <vector>

#include "core/error.h"
#include "core/text/text_file.h"
#include "experiment/output/build_info.h"
#include "experiment/output/result_json.h"
#include "report/report.h"

namespace umbsim {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostBytes = std::size_t(64) << 20;

// The file that tells what a folder holds, and what is shown of it.
struct Told {
  const char* file;
  const char* kind;
  std::vector<const char*> figure;  // where it stands in the file
  const char* name;                 // with its unit
};

const std::vector<Told>& told() {
  static const std::vector<Told> all{
      {"summary.json", "run", {"umbmark", "e_max_syst_m"}, "E_max,syst (m)"},
      {"diagnosis.json", "gap diagnosis", {"verdict"}, ""},
      {"calibration.json", "calibration", {"comparison", "winner", "name"}, "method"},
      {"sweep.json", "sweep", {"done"}, "points"},
      {"explain.json", "explanation", {"scenario"}, "scenario"},
      {"plan.json", "plan", {}, ""},
      {"prediction.json", "prediction", {"predictions", "after", "mean", "final_mm"}, "final error (mm)"},
      {"import.json", "import", {}, ""},
      {"recording.yaml", "recording", {}, ""}};
  return all;
}

Json figure_of(const fs::path& file, const Told& t) {
  if (t.figure.empty() || file.extension() != ".json") return nullptr;
  Json at = Json::parse(read_text_file(file, kMostBytes), nullptr, false);
  for (const char* key : t.figure) {
    if (!at.is_object() || !at.contains(key)) return nullptr;
    at = Json(at[key]);
  }
  return at.is_primitive() ? at : Json();
}

std::optional<Json> entry(const fs::path& folder) {
  for (const Told& t : told()) {
    const fs::path file = folder / t.file;
    if (!fs::exists(file)) continue;
    Json json{{"name", folder.filename().string()}, {"kind", t.kind}, {"page", fs::exists(folder / "report.html")}};
    try {
      json["figure"] = figure_of(file, t);
    } catch (const InputError&) {
      json["figure"] = nullptr;
    }
    json["figure_name"] = t.name;
    return json;
  }
  return std::nullopt;
}

Json index_json(const fs::path& results) {
  std::vector<std::pair<fs::file_time_type, fs::path>> folders;
  for (const auto& item : fs::directory_iterator(results)) {
    const std::string name = item.path().filename();
    if (item.is_directory() && !item.is_symlink() && name[0] != '.')
      folders.emplace_back(item.last_write_time(), item.path());
  }
  std::sort(folders.rbegin(), folders.rend());
  Json json{{"title", "Results"}, {"version", build_info().version}, {"results", Json::array()}};
  for (const auto& [time, folder] : folders) {
    if (auto e = entry(folder)) json["results"].push_back(std::move(*e));
  }
  return json;
}

}  // namespace

void write_index_beside(const std::string& folder) {
  fs::path at = fs::absolute(folder).lexically_normal();
  if (!at.has_filename()) at = at.parent_path();
  const fs::path results = at.parent_path();
  if (results.filename() != "results") return;
  try {
    replace_text_file(results / "index.html", render_report(PageKind::index, index_json(results)));
  } catch (const std::exception&) {  // the list is a convenience; the result stands
  }
}

}  // namespace umbsim
