#include "cli/shipped.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "core/data_folder.h"
#include "core/error.h"
#include "core/text/choices.h"

namespace umbsim {
namespace {

namespace fs = std::filesystem;

struct Kind {
  const char* name;
  const char* folder;  ///< below scenarios/
  const char* command;
};
constexpr Kind kKinds[] = {
    {"scenario", "", "umbsim run"}, {"sweep", "sweeps", "umbsim sweep"}, {"trial", "trials", "umbsim gap trial"}};

const Kind& about(ShippedKind kind) { return kKinds[int(kind)]; }

ShippedFile shipped_file(const fs::path& file) {
  const fs::path below = file.lexically_relative(data_folder("scenarios"));
  for (const ShippedKind kind : {ShippedKind::sweep, ShippedKind::trial}) {
    if (*below.begin() != about(kind).folder) continue;
    return {kind, below.lexically_relative(about(kind).folder).replace_extension(), file};
  }
  return {ShippedKind::scenario, fs::path(below).replace_extension(), file};
}

std::vector<ShippedFile> find_shipped_files() {
  std::vector<ShippedFile> files;
  std::error_code error;  // none: nothing is shipped
  for (const auto& entry : fs::recursive_directory_iterator(data_folder("scenarios"), error)) {
    if (entry.path().extension() == ".yaml") files.push_back(shipped_file(entry.path()));
  }
  std::sort(files.begin(), files.end(), [](const ShippedFile& a, const ShippedFile& b) {
    // Files of the folder itself before those of its folders.
    const auto key = [](const ShippedFile& f) {
      return std::tuple(f.kind, std::count(f.name.begin(), f.name.end(), '/'), f.name);
    };
    return key(a) < key(b);
  });
  return files;
}

// "umbmrk.yaml", "scenarios/umbmrk.yaml" and "umbmrk" all mean the same shipped name.
std::string as_name(const std::string& word, ShippedKind kind) {
  fs::path path = fs::path(word).lexically_normal();
  if (path.extension() == ".yaml") path.replace_extension();
  for (const std::string folder : {"scenarios", about(kind).folder}) {
    if (!folder.empty() && *path.begin() == folder) path = path.lexically_relative(folder);
  }
  return path.string();
}

[[noreturn]] void fail(ShippedKind kind, const std::string& word, std::vector<std::string> choices) {
  const std::string name = as_name(word, kind);
  for (const ShippedFile& f : shipped_files()) {
    if (f.kind != kind && (f.name == name || f.last_name() == name)) {
      throw InputError(fmt::format("{}: cannot be read: No such file; the shipped '{}' is a {}: `{} {}`", word, f.name,
                                   about(f.kind).name, about(f.kind).command, f.name));
    }
    if (f.kind == kind) choices.insert(choices.end(), {f.name, f.last_name()});
  }
  throw InputError(
      fmt::format("{}: cannot be read: No such file, and no shipped {} has this name; {}`umbsim list` shows them", word,
                  about(kind).name, did_you_mean(name, choices)));
}

}  // namespace

std::string ShippedFile::last_name() const { return fs::path(name).filename(); }

const std::vector<ShippedFile>& shipped_files() {
  static const std::vector<ShippedFile> files = find_shipped_files();
  return files;
}

std::string shipped_path(ShippedKind kind, const std::string& word, const std::vector<std::string>& also) {
  std::error_code error;
  const fs::file_type there = fs::status(word, error).type();
  if (there != fs::file_type::not_found && there != fs::file_type::directory) return word;
  std::vector<const ShippedFile*> found;
  for (const ShippedFile& f : shipped_files()) {
    if (f.kind != kind) continue;
    if (f.name == word) return f.path;
    if (f.last_name() == word) found.push_back(&f);
  }
  if (found.size() == 1) return found.front()->path;
  if (found.size() > 1) {
    throw InputError(
        fmt::format("{}: {} shipped files have this name: {}, {}", word, found.size(), found[0]->name, found[1]->name));
  }
  if (there == fs::file_type::directory) return word;  // read_text_file says so
  fail(kind, word, also);
}

}  // namespace umbsim
