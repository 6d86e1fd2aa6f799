#pragma once

#include <string>
#include <vector>

namespace umbsim {

enum class ShippedKind { scenario, sweep, trial };

/// A file of the shipped scenarios/.
struct ShippedFile {
  ShippedKind kind = ShippedKind::scenario;
  std::string name;  ///< what a command takes: its path below the folder of its kind, as in effects/bump
  std::string path;

  std::string last_name() const;  ///< without folders: bump
};

/// Every shipped file, by kind and name.
const std::vector<ShippedFile>& shipped_files();

/// The file that a word of the command line names: one on disk, or else a shipped one by its name, with or without its
/// folder. `also`: other words that stand there, such as subcommands. Throws InputError that says what was meant.
std::string shipped_path(ShippedKind kind, const std::string& word, const std::vector<std::string>& also = {});

}  // namespace umbsim
