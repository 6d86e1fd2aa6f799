#include "tests/bad_input/corpus.h"

#include <stdexcept>

namespace umbsim::acceptance {
namespace {

constexpr const char* kSay = "says ";
constexpr const char* kSetup = "setup ";
constexpr const char* kFile = "file ";
constexpr const char* kCommand = "$ umbsim";

std::string rest(const std::string& line, const char* word) { return line.substr(std::string(word).size()); }

}  // namespace

std::vector<BadCase> read_cases(const fs::path& path) {
  std::ifstream in(path);
  std::vector<BadCase> cases;
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    const std::string where = path.filename().string() + ":" + std::to_string(number);
    if (line.empty() || line[0] == '#') continue;
    if (line.starts_with("== ")) {
      cases.push_back({line.substr(3), where, {}, {}, "", {}});
      continue;
    }
    if (cases.empty()) throw std::runtime_error(where + ": a case begins with `== name`");
    BadCase& c = cases.back();
    if (line.starts_with(kSay)) {
      c.says.push_back(rest(line, kSay));
    } else if (line.starts_with(kSetup)) {
      c.setup.push_back(rest(line, kSetup));
    } else if (line.starts_with(kCommand)) {
      c.command = rest(line, kCommand);
    } else if (line.starts_with(kFile)) {
      auto& [name, text] = c.files.emplace_back(rest(line, kFile), "");
      while (std::getline(in, line) && ++number && line != ".") text += line + "\n";
    } else {
      throw std::runtime_error(where + ": not understood: " + line);
    }
  }
  return cases;
}

}  // namespace umbsim::acceptance
