#include "experiment/output/unfinished.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <string>
#include <vector>

namespace umbsim {
namespace {

namespace fs = std::filesystem;

std::string host() {
  char name[65] = "";
  gethostname(name, sizeof name - 1);
  std::string text = name;
  std::replace(text.begin(), text.end(), '/', '_');
  return text;
}

std::string prefix_of(const fs::path& folder) { return fmt::format(".{}.{}.", folder.filename().string(), host()); }

bool is_alive(const std::string& digits) {
  if (digits.empty() || digits.size() > 9 || digits.find_first_not_of("0123456789") != digits.npos) return true;
  return kill(pid_t(std::stoi(digits)), 0) == 0 || errno == EPERM;
}

void say(const std::string& what) { fmt::print(stderr, "umbsim: note: {}\n", what); }

}  // namespace

fs::path beside(const fs::path& folder, const char* kind) {
  return folder.parent_path() / fmt::format("{}{}{}", prefix_of(folder), getpid(), kind);
}

void tidy_up(const fs::path& folder) {
  const std::string prefix = prefix_of(folder);
  std::error_code error;
  std::vector<fs::path> unfinished, replaced;
  for (const auto& entry : fs::directory_iterator(folder.parent_path(), error)) {
    const std::string name = entry.path().filename().string();
    constexpr const char* kProbe = ".umbsim.";  // of check for a writable folder, empty
    if (name.starts_with(kProbe) && name.ends_with(".probe") && !is_alive(fs::path(name.substr(8)).stem().string())) {
      std::error_code ignored;
      fs::remove(entry.path(), ignored);
    }
    if (!name.starts_with(prefix) || is_alive(fs::path(name.substr(prefix.size())).stem().string())) continue;
    if (name.ends_with(".part")) unfinished.push_back(entry.path());
    if (name.ends_with(".old")) replaced.push_back(entry.path());
  }
  for (const fs::path& old : replaced) {
    if (!fs::exists(folder, error)) {
      fs::rename(old, folder, error);
      say(fmt::format("{}: the result that a killed process was about to replace is put back", folder.string()));
    } else {
      fs::remove_all(old, error);
    }
  }
  for (const fs::path& part : unfinished) {
    fs::remove_all(part, error);
    say(fmt::format("{}: a killed process had begun a result here; what it left is removed", folder.string()));
  }
}

void replace_folder(const fs::path& made, const fs::path& folder, std::error_code& error) {
  if (renameat2(AT_FDCWD, made.c_str(), AT_FDCWD, folder.c_str(), RENAME_EXCHANGE) == 0) {
    std::error_code ignored;
    fs::remove_all(made, ignored);
    return;
  }
  const fs::path old = beside(folder, ".old");
  fs::rename(folder, old, error);
  if (error) return;
  fs::rename(made, folder, error);
  std::error_code ignored;
  if (error)
    fs::rename(old, folder, ignored);
  else
    fs::remove_all(old, ignored);
}

}  // namespace umbsim
