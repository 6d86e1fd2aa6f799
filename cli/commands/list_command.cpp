#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "cli/commands.h"
#include "cli/help/help.h"
#include "cli/shipped.h"
#include "core/text/text_file.h"
#include "core/text/wrapped_text.h"
#include "core/text/yaml_reader.h"
#include "experiment/scenario/robots.h"

namespace umbsim {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestUrdf = 16 << 20;  // bytes
constexpr std::size_t kNameWidth = 25;

/// A heading and the folder of names that it shows.
struct Section {
  ShippedKind kind;
  const char* folder;
  const char* heading;
};
constexpr Section kSections[] = {
    {ShippedKind::scenario, "", "Scenarios, as in `umbsim run umbmark`"},
    {ShippedKind::scenario, "effects", "Scenarios of one effect each, as in `umbsim run bump`"},
    {ShippedKind::sweep, "", "Sweeps, as in `umbsim sweep friction`"},
    {ShippedKind::trial, "", "Trials of the diagnosis, as in `umbsim gap trial ci`"}};

std::string line(const std::string& name, const std::string& text) {
  return fmt::format("  {:<{}} {}\n", name, kNameWidth, shortened(text, kColumns - kNameWidth - 3));
}

// What a scenario says of itself; those of an effect repeat its name.
std::string description(const ShippedFile& file) {
  const std::string text = YamlMap(YamlValue::load(file.path)).string("description", "");
  const std::string prefix = file.last_name() + ": ";
  return text.rfind(prefix, 0) == 0 ? text.substr(prefix.size()) : text;
}

// The beginning of a URDF's first comment, which says what robot it is.
std::string robot_description(const fs::path& urdf) {
  const std::string text = read_text_file(urdf, kLongestUrdf);
  const std::size_t begin = text.find("<!--"), end = text.find("-->");
  if (begin == std::string::npos || end == std::string::npos || end < begin) return "";
  const std::string comment = text.substr(begin + 4, end - begin - 4);
  return comment.substr(0, comment.find("\n\n"));  // its first paragraph
}

std::string robots() {
  std::vector<fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(robots_directory(), error)) {
    if (entry.path().extension() == ".urdf") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::string text = "Robots, as in `--set robot.urdf=labmate.urdf`\n";
  for (const fs::path& file : files) text += line(file.filename(), robot_description(file));
  return text;
}

void list_shipped() {
  for (const Section& s : kSections) {
    fmt::print("{}\n", s.heading);
    for (const ShippedFile& f : shipped_files()) {
      if (f.kind == s.kind && fs::path(f.name).parent_path() == s.folder) {
        fmt::print("{}", line(f.last_name(), description(f)));
      }
    }
    fmt::print("\n");
  }
  fmt::print("{}", robots());
}

}  // namespace

void add_list_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("list", "List the scenarios, sweeps, trials and robots that are shipped");
  add_example(command, "umbsim list");
  command->callback(list_shipped);
}

}  // namespace umbsim
