#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace umbsim::gap {

/// A folder of number lists under hexadecimal keys, shared by any number of processes. Nothing here throws: what cannot
/// be read is not there, what cannot be written is not kept.
class SignatureFiles {
 public:
  SignatureFiles(std::filesystem::path folder, std::uint64_t max_bytes);
  /// Removes the oldest files if there are too many, but only where something was written.
  ~SignatureFiles();
  SignatureFiles(const SignatureFiles&) = delete;
  SignatureFiles& operator=(const SignatureFiles&) = delete;

  /// Nothing unless the file is whole, of this key, and its checksum is right.
  std::optional<std::vector<double>> read(const std::string& key) const;
  void write(const std::string& key, const std::vector<double>& numbers);

 private:
  std::filesystem::path file_of(const std::string& key) const;
  void trim() const;

  std::filesystem::path folder_;
  std::uint64_t max_bytes_;
  std::atomic<bool> writable_{true};
  std::atomic<std::uint64_t> written_{0};
};

}  // namespace umbsim::gap
