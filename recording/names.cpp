#include "recording/names.h"

#include <algorithm>
#include <string_view>

namespace umbsim {
namespace {

// File systems allow 255 bytes for a name.
constexpr std::size_t kMaxIdLength = 200;

}  // namespace

std::string run_id_problem(const std::string& id) {
  if (id.empty()) return "must not be empty";
  if (id.size() > kMaxIdLength) return "must not be longer than " + std::to_string(kMaxIdLength) + " bytes";
  if (id.find_first_of("/\\") != std::string::npos) return "must not contain a path separator";
  if (id == "." || id.find("..") != std::string::npos) return "must not be '.' or contain '..'";
  const auto is_control = [](unsigned char c) { return c < 0x20 || c == 0x7f; };
  if (std::any_of(id.begin(), id.end(), is_control)) return "must not contain control characters";
  return "";
}

std::string urdf_copy_name(const std::string& urdf) {
  std::string name = std::filesystem::path(urdf).filename().string();
  constexpr std::string_view kHarmless = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789._-";
  for (char& c : name) c = kHarmless.find(c) != kHarmless.npos ? c : '_';
  return name.ends_with(".urdf") ? name : name + ".urdf";
}

std::string inner_path_problem(const std::string& path) {
  if (path.empty()) return "must not be empty";
  const std::filesystem::path parts(path);
  const bool climbs = std::find(parts.begin(), parts.end(), "..") != parts.end();
  if (parts.is_absolute() || climbs) return "must stay inside the recording's folder";
  return "";
}

std::string link_problem(const std::filesystem::path& directory, const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code failed;
  const fs::path folder = fs::canonical(directory, failed);
  const fs::path file = failed ? fs::path() : fs::weakly_canonical(directory / path, failed);
  if (failed) return "cannot be read: " + failed.message();
  const auto [end, in_file] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
  if (end == folder.end() && in_file != file.end()) {
    const fs::file_status status = fs::status(file, failed);
    const bool plain = !fs::exists(status) || fs::is_regular_file(status) || fs::is_directory(status);
    return plain ? "" : "is a pipe or a device, not a file";
  }
  return "is a link that leaves the recording's folder: put the file itself there";
}

}  // namespace umbsim
