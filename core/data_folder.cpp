#include "core/data_folder.h"

namespace umbsim {

namespace fs = std::filesystem;

fs::path data_folder(const std::string& name) {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const fs::path installed = program.parent_path().parent_path() / "share" / "umbsim" / name;
  if (!error && fs::is_directory(installed, error)) return installed;
  return fs::path(UMBSIM_SOURCE_DIR) / name;
}

}  // namespace umbsim
