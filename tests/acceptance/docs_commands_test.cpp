// Every command in README.md and docs/ that starts the program is run as printed, in the reader's order.
#include <algorithm>

#include "tests/acceptance/markdown.h"
#include "tests/acceptance/program.h"

namespace umbsim::acceptance {
namespace {

std::vector<std::string> commands_of(const std::string& file) {
  std::vector<std::string> commands;
  for (const std::string& block : fenced_blocks(file, "sh")) {
    std::istringstream lines(block);
    std::string line, whole;
    while (std::getline(lines, line)) {
      whole += line;
      if (!whole.empty() && whole.back() == '\\') {
        whole.pop_back();
        continue;
      }
      if (whole.rfind("./umbsim", 0) == 0) commands.push_back(whole);
      whole.clear();
    }
  }
  return commands;
}

/// A folder in which `./umbsim` is the built program and the shipped files lie as in a checkout.
void lay_out(const Desk& desk) {
  const fs::path source = UMBSIM_SOURCE_DIR;
  for (const char* name : {"scenarios", "robots", "docs", "tests"}) fs::create_symlink(source / name, desk.home / name);
  fs::create_symlink(UMBSIM_PROGRAM, desk.home / "umbsim");
  if (fs::is_directory(UMBSIM_SHARED_DIR)) fs::create_symlink(UMBSIM_SHARED_DIR, desk.home.parent_path() / "shared");
}

/// README.md and every page of docs/, below the project.
std::vector<std::string> pages() {
  std::vector<std::string> all;
  for (const auto& entry : fs::directory_iterator(fs::path(UMBSIM_SOURCE_DIR) / "docs")) {
    if (entry.path().extension() == ".md") all.push_back("docs/" + entry.path().filename().string());
  }
  std::sort(all.begin(), all.end());
  all.insert(all.begin(), "README.md");
  return all;
}

class Document : public testing::TestWithParam<std::string> {};

TEST_P(Document, CommandsWorkAsPrinted) {
  const std::vector<std::string> commands = commands_of(std::string(UMBSIM_SOURCE_DIR) + "/" + GetParam());
  const Desk desk;
  lay_out(desk);
  for (const std::string& command : commands) {
    SCOPED_TRACE(command);
    if (command.find("../shared/") != std::string::npos && !fs::exists(desk.home.parent_path() / "shared")) {
      std::cout << "left out, the recordings are not here: " << command << "\n";
      continue;
    }
    const Outcome outcome = desk.shell(command);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
  }
}

INSTANTIATE_TEST_SUITE_P(Every, Document, testing::ValuesIn(pages()), [](const auto& param_info) {
  std::string name = param_info.param == "README.md" ? "README" : "docs_" + fs::path(param_info.param).stem().string();
  for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return name;
});

TEST(Readme, ShowsCommands) { EXPECT_GE(commands_of(std::string(UMBSIM_SOURCE_DIR) + "/README.md").size(), 5u); }

// Links to files of the project lead somewhere.
TEST(Documents, LinksLeadSomewhere) {
  std::vector<fs::path> files{fs::path(UMBSIM_SOURCE_DIR) / "CHANGELOG.md"};
  for (const std::string& page : pages()) files.push_back(fs::path(UMBSIM_SOURCE_DIR) / page);
  for (const fs::path& file : files) {
    const std::string text = text_of(file);
    for (std::size_t at = text.find("]("); at != std::string::npos; at = text.find("](", at + 1)) {
      std::string target = text.substr(at + 2, text.find(')', at) - at - 2);
      target = target.substr(0, target.find('#'));
      if (target.empty() || target.find("://") != std::string::npos) continue;
      EXPECT_TRUE(fs::exists(file.parent_path() / target)) << file << " links to " << target;
    }
  }
}

}  // namespace
}  // namespace umbsim::acceptance
