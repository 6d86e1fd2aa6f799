#include "core/data_folder.h"

#include <sys/auxv.h>

namespace umbsim {

namespace fs = std::filesystem;

namespace {

// Where there is no /proc, as in a bare chroot, by the name under which it was started.
fs::path this_program() {
  std::error_code error;
  const fs::path linked = fs::read_symlink("/proc/self/exe", error);
  if (!error) return linked;
  const auto* started = reinterpret_cast<const char*>(getauxval(AT_EXECFN));
  return started ? fs::canonical(started, error) : fs::path();
}

}  // namespace

fs::path data_folder(const std::string& name) {
  std::error_code error;
  const fs::path installed = this_program().parent_path().parent_path() / "share" / "umbsim" / name;
  if (fs::is_directory(installed, error)) return installed;
  return fs::path(UMBSIM_SOURCE_DIR) / name;
}

}  // namespace umbsim
