#pragma once

#include <string>
#include <utility>
#include <vector>

#include "exchange/import/options.h"

namespace umbsim::exchange {

/// Names of the left and the right drive joint among `joints`: those of --left-joint and --right-joint, else the only
/// ones whose names say so. Throws InputError that lists them and asks for the options.
std::pair<std::string, std::string> choose_joints(const std::vector<std::string>& joints, const ImportOptions& options,
                                                  const std::string& where);

}  // namespace umbsim::exchange
