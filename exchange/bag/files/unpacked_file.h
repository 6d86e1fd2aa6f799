#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace umbsim::exchange {

/// Whether bytes begin as zstd writes them.
bool is_zstd(const void* data, std::size_t size);

/// One zstd frame that says its size. Throws InputError.
std::vector<std::uint8_t> unpacked_message(const std::uint8_t* data, std::size_t size);

/// A file that zstd packed as a whole, unpacked into a file in TMPDIR that has no name: it goes with the program,
/// however that ends.
class UnpackedFile {
 public:
  /// Throws InputError: damaged, cut off, no room.
  explicit UnpackedFile(const std::string& file);
  ~UnpackedFile();
  UnpackedFile(const UnpackedFile&) = delete;
  UnpackedFile& operator=(const UnpackedFile&) = delete;

  /// By which this process can open it.
  std::string path() const;
  /// Its own copy: what is written here stays in memory.
  std::uint8_t* data() const { return data_; }
  std::size_t size() const { return size_; }

 private:
  void unpack(const std::string& file);
  int handle_ = -1;
  std::uint8_t* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace umbsim::exchange
