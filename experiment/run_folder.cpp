#include "experiment/run_folder.h"

#include <unistd.h>

#include <fmt/format.h>

#include "core/error.h"
#include "core/text_file.h"
#include "experiment/result_json.h"

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
    throw InputError(fmt::format("{}: exists and is not a result of this program; give another folder with --out",
                                 folder.string()));
  }
  if (!force) {
    throw InputError(fmt::format("{}: already holds a finished result; use --force to replace it, or --out for another "
                                 "folder", folder.string()));
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

void write_folder(const fs::path& given, bool force, const std::function<void(const fs::path&)>& fill) {
  const fs::path folder = without_slash(given);
  check_output_folder(folder, force);
  const fs::path absolute = fs::absolute(folder);
  const fs::path beside = absolute.parent_path() / fmt::format(".{}.{}.part", absolute.filename().string(), getpid());
  const fs::path old = absolute.parent_path() / fmt::format(".{}.{}.old", absolute.filename().string(), getpid());
  std::error_code error;
  try {
    fs::create_directories(beside, error);
    if (error) fail(folder, error);
    fill(beside);
    if (fs::exists(absolute)) fs::rename(absolute, old);
    fs::rename(beside, absolute, error);
    if (error) {
      if (fs::exists(old)) fs::rename(old, absolute);
      fail(folder, error);
    }
    fs::remove_all(old, error);
  } catch (const fs::filesystem_error& e) {
    fs::remove_all(beside, error);
    fail(folder, e.code());
  } catch (...) {
    fs::remove_all(beside, error);
    throw;
  }
}

void write_run_folder(const ExperimentResult& result, const std::string& page, const fs::path& folder, bool force) {
  write_folder(folder, force, [&](const fs::path& into) {
    write_recording(result.recording, into);
    write_text_file(into / "scenario.resolved.yaml", resolved_yaml(result.scenario));
    write_text_file(into / "provenance.json",
                    provenance_json(result.scenario.file, result.scenario.seed).dump(2) + "\n");
    write_text_file(into / "summary.json", summary_json(result).dump(2) + "\n");
    write_text_file(into / "report.html", page);
    if (result.passes.empty()) return;
    const CalibrationPass& last = result.passes.back();
    write_text_file(into / "calibration.yaml",
                    calibration_yaml(last.odometry, "Calibrated odometry of scenario " + result.scenario.name));
    fs::create_directory(into / "calibrated");
    write_recording(last.recording, into / "calibrated");
  });
}

}  // namespace umbsim
