#pragma once

#include <string>

namespace umbsim {

/// What this program was built from and with.
struct BuildInfo {
  std::string version;
  std::string commit;  ///< with "+" if the tree had changes; "unknown" outside a checkout
  std::string compiler;
  std::string bullet;
  std::string build_type;
};

BuildInfo build_info();

}  // namespace umbsim
