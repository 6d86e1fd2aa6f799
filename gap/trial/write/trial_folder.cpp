#include "gap/trial/write/trial_folder.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>

#include "core/error.h"
#include "core/text/text_file.h"

namespace umbsim {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxJsonBytes = 256 * 1024 * 1024;
constexpr std::time_t kFileTime = 946684800;  // 2000-01-01

// Unique among processes on one machine, and among machines that share a folder.
fs::path beside(const fs::path& path) {
  char host[256] = "";
  gethostname(host, sizeof host - 1);
  return path.parent_path() / fmt::format(".{}.{}.{}.part", path.filename().string(), host, getpid());
}

}  // namespace

std::vector<CaseEntry> read_case_entries(const TrialFolder& folder) {
  std::vector<CaseEntry> entries;
  if (fs::exists(folder.cases())) {
    const Json json = read_json(folder.cases());
    try {
      for (const Json& item : json.at("cases")) {
        entries.push_back({item.at("name").get<std::string>(), item.at("exclude").get<std::vector<std::string>>()});
      }
    } catch (const nlohmann::json::exception& e) {
      throw InputError(fmt::format("{}: {}", folder.cases().string(), e.what()));
    }
  } else {
    if (!fs::is_directory(folder.recordings())) {
      throw InputError(fmt::format("{}: no such folder of recordings", folder.recordings().string()));
    }
    for (const auto& entry : fs::directory_iterator(folder.recordings())) {
      const std::string name = entry.path().filename().string();
      if (entry.is_directory() && name.front() != '.') entries.push_back({name, {}});
    }
  }
  std::sort(entries.begin(), entries.end(), [](const CaseEntry& a, const CaseEntry& b) { return a.name < b.name; });
  if (entries.empty()) throw InputError(fmt::format("{}: has no cases", folder.root.string()));
  return entries;
}

std::string case_entries_text(const std::string& trial, const std::vector<CaseEntry>& entries) {
  Json json{{"format", "umbsim-trial-cases/1"}, {"trial", trial}, {"cases", Json::array()}};
  for (const CaseEntry& entry : entries) json["cases"].push_back({{"name", entry.name}, {"exclude", entry.excluded}});
  return json.dump(1) + "\n";
}

Json read_json(const fs::path& file) {
  try {
    return Json::parse(read_text_file(file, kMaxJsonBytes));
  } catch (const nlohmann::json::exception& e) {
    throw InputError(fmt::format("{}: is not JSON: {}", file.string(), e.what()));
  }
}

void write_whole(const fs::path& folder, const std::function<void(const fs::path&)>& fill) {
  if (fs::exists(folder)) return;
  const fs::path part = beside(folder);
  std::error_code error;
  try {
    fs::remove_all(part);
    fs::create_directories(part);
    fill(part);
    fs::rename(part, folder, error);
    // Another process may have finished the same case: equal by construction.
    if (error && !fs::exists(folder)) throw RunError(fmt::format("{}: {}", folder.string(), error.message()));
    fs::remove_all(part, error);
  } catch (const fs::filesystem_error& e) {
    fs::remove_all(part, error);
    throw RunError(fmt::format("{}: cannot be written: {}", folder.string(), e.code().message()));
  } catch (...) {
    fs::remove_all(part, error);
    throw;
  }
}

void write_file_whole(const fs::path& file, const std::string& text) {
  const fs::path part = beside(file);
  if (file.has_parent_path()) fs::create_directories(file.parent_path());
  write_text_file(part, text);
  fs::rename(part, file);
}

void normalise_times(const fs::path& folder) {
  const auto since = std::chrono::system_clock::from_time_t(kFileTime);
  const auto time = std::chrono::file_clock::from_sys(since);
  for (const auto& entry : fs::recursive_directory_iterator(folder)) fs::last_write_time(entry.path(), time);
  fs::last_write_time(folder, time);
}

ScratchFolder::ScratchFolder() {
  std::string pattern = (fs::temp_directory_path() / "umbsim_XXXXXX").string();
  if (!mkdtemp(pattern.data())) throw RunError("no temporary folder: " + pattern);
  path_ = pattern;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace umbsim
