#include "exchange/bag/files/unpacked_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>
#include <zstd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>

#include "core/error.h"
#include "core/progress.h"
#include "exchange/bag/files/mapped_file.h"

namespace umbsim::exchange {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& file, const std::string& what) { throw InputError(SourceMark{file}, what); }

int nameless_file(const std::string& file) {
  std::string name = (fs::temp_directory_path() / "umbsim-bag-XXXXXX").string();
  const int handle = mkostemp(name.data(), O_CLOEXEC);
  if (handle < 0) {
    fail(file, fmt::format("cannot be unpacked into {}: {}; set TMPDIR", name, std::strerror(errno)));
  }
  unlink(name.c_str());
  return handle;
}

void write_all(int handle, const char* data, std::size_t size, const std::string& file) {
  while (size > 0) {
    const ssize_t written = write(handle, data, size);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      fail(file, fmt::format("cannot be unpacked into {}: {}; set TMPDIR to a folder with room",
                             fs::temp_directory_path().string(), std::strerror(errno)));
    }
    data += written;
    size -= std::size_t(written);
  }
}

}  // namespace

bool is_zstd(const void* data, std::size_t size) {
  constexpr char kZstd[] = "\x28\xb5\x2f\xfd";
  return size >= 4 && std::memcmp(data, kZstd, 4) == 0;
}

std::vector<std::uint8_t> unpacked_message(const std::uint8_t* data, std::size_t size) {
  constexpr unsigned long long kLargest = 1ull << 30;
  const unsigned long long whole = ZSTD_getFrameContentSize(data, size);
  if (whole > kLargest) throw InputError("is packed by zstd and does not say a usable size");
  std::vector<std::uint8_t> out(whole);
  const std::size_t result = ZSTD_decompress(out.data(), out.size(), data, size);
  if (ZSTD_isError(result) || result != out.size()) throw InputError("is damaged: zstd cannot unpack it");
  return out;
}

UnpackedFile::UnpackedFile(const std::string& file) : handle_(nameless_file(file)) {
  try {
    unpack(file);
  } catch (...) {
    close(handle_);
    throw;
  }
  void* memory = size_ > 0 ? mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_PRIVATE, handle_, 0) : nullptr;
  if (memory == MAP_FAILED) {
    close(handle_);
    fail(file, fmt::format("cannot be read: {}", std::strerror(errno)));
  }
  data_ = static_cast<std::uint8_t*>(memory);
}

UnpackedFile::~UnpackedFile() {
  if (data_) munmap(data_, size_);
  close(handle_);
}

std::string UnpackedFile::path() const { return fmt::format("/proc/self/fd/{}", handle_); }

void UnpackedFile::unpack(const std::string& file) {
  const MappedFile packed(file);
  const std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> context(ZSTD_createDCtx(), ZSTD_freeDCtx);
  std::vector<char> buffer(ZSTD_DStreamOutSize());
  ZSTD_inBuffer in{packed.data(), packed.size(), 0};
  Progress progress("unpacking " + fs::path(file).filename().string(), 100);
  std::size_t left = 1;
  while (in.pos < in.size) {
    ZSTD_outBuffer out{buffer.data(), buffer.size(), 0};
    left = ZSTD_decompressStream(context.get(), &out, &in);
    if (ZSTD_isError(left)) fail(file, fmt::format("is damaged: zstd says: {}", ZSTD_getErrorName(left)));
    write_all(handle_, buffer.data(), out.pos, file);
    size_ += out.pos;
    progress.reach(int(100 * in.pos / std::max<std::size_t>(in.size, 1)));
  }
  if (left != 0) fail(file, "is cut off: zstd cannot unpack it to its end");
}

}  // namespace umbsim::exchange
