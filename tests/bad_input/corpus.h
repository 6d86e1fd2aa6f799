#pragma once

#include <string>
#include <vector>

#include "tests/acceptance/program.h"

namespace umbsim::acceptance {

/// One way to go wrong, as the files in corpus/ write it down; README.md says how.
struct BadCase {
  std::string name;
  std::string where;               ///< file and line, for messages
  std::vector<std::string> setup;  ///< shell lines, in the folder of the case
  std::vector<std::pair<std::string, std::string>> files;
  std::string command;            ///< words behind `umbsim`, for the shell
  std::vector<std::string> says;  ///< all of them must be in the message
};

/// The cases of one file. Throws std::runtime_error for a line that it does not know.
std::vector<BadCase> read_cases(const fs::path& file);

}  // namespace umbsim::acceptance
