// Every command in README.md and docs/ that starts the program is run as printed, in the reader's order.
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

class Document : public testing::TestWithParam<const char*> {};

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

INSTANTIATE_TEST_SUITE_P(Every, Document,
                         testing::Values("README.md", "docs/life-of-a-run.md", "docs/scenario.md", "docs/outputs.md",
                                         "docs/recording-format.md", "docs/conventions.md", "docs/architecture.md",
                                         "docs/physics.md", "docs/sweep.md", "docs/sweep-database.md", "docs/ci.md",
                                         "docs/cluster.md", "docs/calibration.md", "docs/your-robot.md", "docs/pages.md"),
                         [](const auto& param_info) {
                           std::string name = fs::path(param_info.param).stem().string();
                           for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
                           return name;
                         });

TEST(Readme, ShowsCommands) {
  EXPECT_GE(commands_of(std::string(UMBSIM_SOURCE_DIR) + "/README.md").size(), 5u);
}

// Links to files of the project lead somewhere.
TEST(Documents, LinksLeadSomewhere) {
  std::vector<fs::path> files{fs::path(UMBSIM_SOURCE_DIR) / "README.md", fs::path(UMBSIM_SOURCE_DIR) / "CHANGELOG.md"};
  for (const auto& entry : fs::directory_iterator(fs::path(UMBSIM_SOURCE_DIR) / "docs")) {
    if (entry.path().extension() == ".md") files.push_back(entry.path());
  }
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
