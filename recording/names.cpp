#include "recording/names.h"

#include <algorithm>
#include <filesystem>

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

std::string inner_path_problem(const std::string& path) {
  if (path.empty()) return "must not be empty";
  const std::filesystem::path parts(path);
  const bool climbs = std::find(parts.begin(), parts.end(), "..") != parts.end();
  if (parts.is_absolute() || climbs) return "must stay inside the recording's folder";
  return "";
}

}  // namespace umbsim
