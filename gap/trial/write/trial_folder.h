#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "batch/shard.h"

namespace umbsim {

using Json = nlohmann::ordered_json;

/// The folder of a trial:
///   trial.yaml       the trial, every default written out
///   cases.json       names of the cases, and what each diagnosis must do without
///   recordings/      one recording for each case, under its name
///   answers.json     sealed: what is wrong in each; answers.sha256 its hash
///   diagnoses/       one folder for each case
///   score/           the figures
struct TrialFolder {
  explicit TrialFolder(std::filesystem::path folder) : root(std::move(folder)) {}
  std::filesystem::path root;
  std::filesystem::path plan() const { return root / "trial.yaml"; }
  std::filesystem::path cases() const { return root / "cases.json"; }
  std::filesystem::path recordings() const { return root / "recordings"; }
  std::filesystem::path answers() const { return root / "answers.json"; }
  std::filesystem::path answer_parts() const { return root / "answers.parts"; }
  std::filesystem::path seal() const { return root / "answers.sha256"; }
  std::filesystem::path diagnoses() const { return root / "diagnoses"; }
  std::filesystem::path score() const { return root / "score"; }
};

/// One line of cases.json.
struct CaseEntry {
  std::string name;
  std::vector<std::string> excluded;
};

/// Reads cases.json; where there is none, every folder of recordings/ is a case. Sorted by name. Throws InputError.
std::vector<CaseEntry> read_case_entries(const TrialFolder& folder);
std::string case_entries_text(const std::string& trial, const std::vector<CaseEntry>& entries);

/// Parses a JSON file. Throws InputError naming it.
Json read_json(const std::filesystem::path& file);

/// Fills a folder beside the wanted one and renames it when complete. Nothing happens if it already stands.
void write_whole(const std::filesystem::path& folder, const std::function<void(const std::filesystem::path&)>& fill);

/// Writes a file beside and renames it, so that nobody ever reads half of it.
void write_file_whole(const std::filesystem::path& file, const std::string& text);

/// Gives a folder and all that is in it one and the same time, so that times tell nothing.
void normalise_times(const std::filesystem::path& folder);

/// A temporary folder, removed at the end.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace umbsim
