#include "experiment/output/run_folder.h"

#include <fmt/format.h>
#include <unistd.h>

#include <vector>

#include "core/error.h"
#include "core/text/text_file.h"
#include "experiment/output/result_json.h"
#include "experiment/output/unfinished.h"
#include "recording/run_writer.h"

namespace umbsim {
namespace {

namespace fs = std::filesystem;

fs::path without_slash(fs::path folder) {
  if (!folder.has_filename()) folder = folder.parent_path();
  return folder;
}

[[noreturn]] void fail(const fs::path& folder, const std::error_code& error) {
  throw RunError(fmt::format("{}: cannot write the result: {}", folder.string(), error.message()));
}

}  // namespace

void check_output_folder(const fs::path& given, bool force) {
  const fs::path folder = without_slash(given);
  std::error_code error;
  if (!fs::exists(folder, error)) return;
  if (!fs::is_directory(folder)) {
    throw InputError(fmt::format("{}: is not a folder; give another one with --out", folder.string()));
  }
  if (fs::is_empty(folder, error)) return;
  const bool ours = fs::exists(folder / "provenance.json");
  if (!ours) {
    throw InputError(
        fmt::format("{}: exists and is not a result of this program; give another folder with --out", folder.string()));
  }
  if (!force) {
    throw InputError(
        fmt::format("{}: already holds a finished result; use --force to replace it, or --out for another "
                    "folder",
                    folder.string()));
  }
}

void prepare_output_folder(const fs::path& given, bool force) {
  check_output_folder(given, force);
  // Writable is asked of the nearest folder that exists; nothing is left there.
  fs::path parent = fs::absolute(without_slash(given)).parent_path();
  std::error_code error;
  while (!fs::exists(parent, error) && parent.has_relative_path()) parent = parent.parent_path();
  const fs::path probe = parent / fmt::format(".umbsim.{}.probe", getpid());
  fs::create_directory(probe, error);
  if (error) fail(given, error);
  fs::remove(probe, error);
}

namespace {

// Folders that had to be made on the way to `folder`, the innermost first.
std::vector<fs::path> missing_above(const fs::path& folder) {
  std::vector<fs::path> missing;
  std::error_code error;
  for (fs::path at = folder.parent_path(); !fs::exists(at, error) && at.has_relative_path(); at = at.parent_path()) {
    missing.push_back(at);
  }
  return missing;
}

}  // namespace

void write_folder(const fs::path& given, bool force, const std::function<void(const fs::path&)>& fill) {
  const fs::path folder = without_slash(given);
  check_output_folder(folder, force);
  const fs::path absolute = fs::absolute(folder);
  tidy_up(absolute);
  const fs::path part = beside(absolute, ".part");
  const std::vector<fs::path> made = missing_above(absolute);
  const auto leave_nothing = [&] {
    std::error_code ignored;
    fs::remove_all(part, ignored);
    for (const fs::path& folder_made : made) fs::remove(folder_made, ignored);  // only where it is empty
  };
  std::error_code error;
  try {
    fs::create_directories(part, error);
    if (error) fail(folder, error);
    fill(part);
    // Unasked only an empty folder is replaced, which rename does by itself, even if one was filled meanwhile.
    if (force && fs::exists(absolute))
      replace_folder(part, absolute, error);
    else
      fs::rename(part, absolute, error);
    if (error) fail(folder, error);
  } catch (const fs::filesystem_error& e) {
    leave_nothing();
    fail(folder, e.code());
  } catch (...) {
    leave_nothing();
    throw;
  }
}

void complete_run_folder(const ExperimentResult& result, const std::string& page, const fs::path& into) {
  write_recording_header(result.recording, into);
  write_scenario(result.scenario, into / "scenario.resolved.yaml");
  write_text_file(into / "provenance.json", provenance_json(result.scenario.file, result.scenario.seed).dump(2) + "\n");
  write_text_file(into / "summary.json", summary_json(result).dump(2) + "\n");
  if (!page.empty()) write_text_file(into / "report.html", page);
  if (result.passes.empty()) return;
  const CalibrationPass& last = result.passes.back();
  write_text_file(into / "calibration.yaml",
                  calibration_yaml(last.odometry, "Calibrated odometry of scenario " + result.scenario.name));
  write_recording_header(last.recording, into / "calibrated");
}

}  // namespace umbsim
