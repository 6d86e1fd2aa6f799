#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <utility>

#include "cli/commands.h"
#include "cli/exit.h"
#include "cli/help/help.h"
#include "cli/output/pages.h"
#include "core/error.h"
#include "core/text/text_file.h"
#include "experiment/output/build_info.h"
#include "experiment/output/recording_page.h"
#include "experiment/output/result_folder.h"
#include "report/score_page.h"

namespace umbsim {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostBytes = std::size_t(256) << 20;

struct ReportArguments {
  std::string folder;
  bool open = false;
};

struct Page {
  PageKind kind;
  Json data;
};

Json json_of(const fs::path& file) {
  Json json = Json::parse(read_text_file(file, kMostBytes), nullptr, false);
  if (!json.is_object()) throw InputError(file.string() + ": is not a JSON object");
  return json;
}

Json provenance_of(const fs::path& folder) {
  if (!fs::exists(folder / "provenance.json")) return nullptr;
  Json json = json_of(folder / "provenance.json");
  json.erase("host");
  json.erase("input");
  return json;
}

// "squares" of squares-calibration.
std::string subject_of(const fs::path& folder) {
  const std::string name = folder_name(folder);
  return name.substr(0, name.rfind('-'));
}

PageKind kind_of(const Json& data) {
  const std::pair<const char*, PageKind> kinds[] = {{"run", PageKind::run},
                                                    {"recording", PageKind::recording},
                                                    {"sweep", PageKind::sweep},
                                                    {"gap", PageKind::gap},
                                                    {"explanation", PageKind::explanation}};
  for (const auto& [name, kind] : kinds) {
    if (data["page"] == name) return kind;
  }
  throw InputError(fmt::format("its report.html is a page of the kind '{}', which this program does not make again",
                               data.value("page", "")));
}

// What a page showed that needs more than the result's files: paths of a diagnosis, rows of a sweep, loads of a run.
std::optional<Page> of_old_page(const fs::path& folder) {
  if (!fs::exists(folder / "report.html")) return std::nullopt;
  std::optional<Json> data = page_data(read_text_file(folder / "report.html", kMostBytes));
  if (!data) return std::nullopt;
  const PageKind kind = kind_of(*data);
  return Page{kind, std::move(*data)};
}

// The runs of an explanation, which its file does not hold.
Json driven_of(const Json& page) {
  Json json = Json::object();
  for (const char* key : {"runs", "robot", "floor", "side_m", "wheelbase_m"}) {
    if (page.contains(key)) json[key] = page[key];
  }
  return json;
}

Page page_of(const fs::path& folder) {
  const auto has = [&](const char* name) { return fs::exists(folder / name); };
  const Json provenance = provenance_of(folder);
  if (has("calibration.json"))
    return {PageKind::calibration,
            calibration_page(json_of(folder / "calibration.json"), subject_of(folder), provenance)};
  if (has("explain.json")) {
    Page page{PageKind::explanation, explanation_page(json_of(folder / "explain.json"), provenance)};
    if (const auto old = of_old_page(folder)) page.data.update(driven_of(old->data));
    return page;
  }
  if (has("plan.json"))
    return {PageKind::plan, plan_page(json_of(folder / "plan.json"), subject_of(folder), provenance)};
  if (has("prediction.json"))
    return {PageKind::prediction, prediction_page(json_of(folder / "prediction.json"), subject_of(folder), provenance)};
  for (const char* score : {"worlds.json", "confusion.csv"}) {
    if (!has(score)) continue;
    const fs::path file = folder / (std::string(score) == "worlds.json" ? score : "summary.json");
    return {PageKind::score, score_page(json_of(file), folder, build_info().version, provenance)};
  }
  if (auto old = of_old_page(folder)) return std::move(*old);
  if (has("recording.yaml"))
    return {has("summary.json") ? PageKind::run : PageKind::recording, recording_report_json(folder)};
  if (has("diagnosis.json") || has("sweep.json"))
    throw InputError(folder.string() + ": its page needs what only the page itself holds, and report.html is gone");
  throw InputError(folder.string() + ": is no result of this program, and no recording");
}

void report(const ReportArguments& a) {
  if (!has_pages())
    throw InputError("report: this program was built without pages (-DUMBSIM_PAGES=ON builds it with them)");
  const fs::path folder = a.folder;
  if (!fs::is_directory(folder)) throw InputError(folder.string() + ": is not a folder");
  const Page page = page_of(folder);
  write_page(folder, page.kind, page.data);
  fmt::print("{}: {}\n", page.data.value("title", ""), page_said(folder.string()));
  finish_page(folder.string(), a.open);
}

}  // namespace

void add_report_command(CLI::App& app) {
  const auto a = std::make_shared<ReportArguments>();
  CLI::App* command = app.add_subcommand("report", "Make the page (report.html) of any result or recording again");
  command->add_option("folder", a->folder, "Folder of a result, or of a recording (real, simulated or imported)")
      ->required();
  add_open_option(command, a->open);
  add_example(command, "umbsim report results/umbmark --open");
  command->callback([a] { report(*a); });
}

}  // namespace umbsim
