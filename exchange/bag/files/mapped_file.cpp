#include "exchange/bag/files/mapped_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/error.h"

namespace umbsim::exchange {

MappedFile::MappedFile(const std::string& file) {
  const int handle = open(file.c_str(), O_RDONLY | O_CLOEXEC);
  struct stat status {};
  if (handle < 0 || fstat(handle, &status) != 0) {
    const int error = errno;
    if (handle >= 0) close(handle);
    throw InputError(SourceMark{file}, fmt::format("cannot be read: {}", std::strerror(error)));
  }
  size_ = std::size_t(status.st_size);
  void* memory = size_ > 0 ? mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, handle, 0) : nullptr;
  const int error = errno;
  close(handle);
  if (memory == MAP_FAILED) throw InputError(SourceMark{file}, fmt::format("cannot be read: {}", std::strerror(error)));
  data_ = static_cast<const std::uint8_t*>(memory);
}

MappedFile::~MappedFile() {
  if (data_) munmap(const_cast<std::uint8_t*>(data_), size_);
}

}  // namespace umbsim::exchange
