#include "experiment/output/result_folder.h"

#include <fmt/format.h>
#include <unistd.h>

#include <stdexcept>

#include "core/error.h"
#include "experiment/output/run_folder.h"

namespace umbsim {
namespace {

namespace fs = std::filesystem;

constexpr const char* kResults = "results";
constexpr const char* kLatest = "latest";
constexpr const char* kReference = "reference";  // shipped figures

fs::path numbered(const std::string& name, int number) {
  return fs::path(kResults) / (number == 1 ? name : fmt::format("{}-{}", name, number));
}

bool is_reserved(const fs::path& folder) { return folder.filename() == kLatest || folder.filename() == kReference; }

bool is_free(const fs::path& folder) {
  std::error_code error;
  const fs::file_status status = fs::symlink_status(folder, error);
  if (status.type() == fs::file_type::not_found) return true;
  return status.type() == fs::file_type::directory && fs::is_empty(folder, error);
}

bool is_in_results(const fs::path& folder) { return fs::absolute(folder).parent_path() == fs::absolute(kResults); }

// results/latest -> `folder`, in one step. Where links cannot be made there is none.
void point_latest(const fs::path& folder) {
  if (!is_in_results(folder)) return;
  const fs::path parent = fs::absolute(kResults);
  const fs::path link = parent / kLatest, beside = parent / fmt::format(".{}.{}.part", kLatest, getpid());
  std::error_code error;
  const fs::file_type there = fs::symlink_status(link, error).type();
  if (there != fs::file_type::symlink && there != fs::file_type::not_found) return;  // someone's own
  fs::create_directory_symlink(folder.filename(), beside, error);
  if (!error) fs::rename(beside, link, error);
  if (error) fs::remove(beside, error);
}

}  // namespace

ResultFolder::ResultFolder(const std::string& out, const std::string& name, bool force)
    : folder_(fs::path(out).lexically_normal()), name_(out.empty() ? name : ""), force_(force) {
  if (!folder_.has_filename()) folder_ = folder_.parent_path();
  if (!name_.empty()) take_next();
  if (folder_.filename() == kLatest && is_in_results(folder_)) {
    throw InputError(fmt::format("{}: is the link to the newest result; give another folder with --out", path()));
  }
  prepare_output_folder(folder_, force_);
}

void ResultFolder::take_next() {
  do {
    folder_ = numbered(name_, ++number_);
  } while (is_reserved(folder_) || (!force_ && !is_free(folder_)));
}

void ResultFolder::place(const Write& write) {
  const bool may_move = !name_.empty() && !force_;
  for (bool written = false; !written;) {
    try {
      write(folder_, force_);
      written = true;
    } catch (const std::runtime_error&) {
      if (!may_move || is_free(folder_)) throw;
      take_next();
    }
  }
  point_latest(folder_);
}

void ResultFolder::write(const Fill& fill) {
  place([&](const fs::path& folder, bool force) { write_folder(folder, force, fill); });
}

std::string ResultFolder::said() const {
  if (number_ < 2 || force_) return path();
  return fmt::format("{} ({} is kept)", path(), numbered(name_, number_ - 1).string());
}

std::string folder_name(const fs::path& path) {
  std::error_code error;
  const fs::path canonical = fs::weakly_canonical(path, error);
  const fs::path whole = (error ? fs::absolute(path).lexically_normal() : canonical) / "";
  return whole.parent_path().filename().string();
}

}  // namespace umbsim
