#pragma once

#include <fstream>
#include <string>
#include <vector>

namespace umbsim::acceptance {

/// The fenced blocks of one language (```yaml ... ```) in a Markdown file, in order.
inline std::vector<std::string> fenced_blocks(const std::string& file, const std::string& language) {
  std::vector<std::string> blocks;
  std::ifstream stream(file);
  std::string line;
  bool inside = false;
  while (std::getline(stream, line)) {
    if (!inside && line == "```" + language) {
      inside = true;
      blocks.emplace_back();
    } else if (inside && line == "```") {
      inside = false;
    } else if (inside) {
      blocks.back() += line + "\n";
    }
  }
  return blocks;
}

}  // namespace umbsim::acceptance
