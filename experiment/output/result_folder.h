#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace umbsim {

/// Where a command's result goes: the folder of --out, or below results/ the first of `name`, `name`-2, `name`-3, ...
/// that holds nothing. With --force the folder itself is replaced.
class ResultFolder {
 public:
  /// `out`: of --out, may be empty. Throws InputError or RunError where nothing can be written: before the work rather
  /// than after it.
  ResultFolder(const std::string& out, const std::string& name, bool force);

  using Write = std::function<void(const std::filesystem::path& folder, bool force)>;
  using Fill = std::function<void(const std::filesystem::path& into)>;

  /// Calls `write`, which writes the folder whole or throws; again with the next default folder if this one was taken
  /// during the work. Below results/ the link `latest` points to it then.
  void place(const Write& write);
  /// The same by write_folder.
  void write(const Fill& fill);

  std::string path() const { return folder_.string(); }
  /// The path, and what was kept for it: "results/umbmark-2 (results/umbmark is kept)".
  std::string said() const;

 private:
  void take_next();

  std::filesystem::path folder_;
  std::string name_;  ///< empty with --out
  int number_ = 0;
  bool force_;
};

/// The name of a folder that was given by any path, links resolved: what a result made from it is called after.
std::string folder_name(const std::filesystem::path& path);

}  // namespace umbsim
