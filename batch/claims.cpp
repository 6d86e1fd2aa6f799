#include "batch/claims.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include <fmt/format.h>

#include "core/error.h"

namespace umbsim {
namespace {

struct flock byte_lock(short type, std::int64_t number) {
  struct flock lock {};
  lock.l_type = type;
  lock.l_whence = SEEK_SET;
  lock.l_start = number;
  lock.l_len = 1;
  return lock;
}

}  // namespace

Claims::Claims(const std::filesystem::path& file)
    : descriptor_(open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
  if (descriptor_ < 0) throw RunError(fmt::format("{}: cannot be made: {}", file.string(), std::strerror(errno)));
}

Claims::~Claims() { close(descriptor_); }

bool Claims::take(std::int64_t number) {
  struct flock lock = byte_lock(F_WRLCK, number);
  return fcntl(descriptor_, F_OFD_SETLK, &lock) == 0 || (errno != EAGAIN && errno != EACCES);
}

void Claims::release(std::int64_t number) {
  struct flock lock = byte_lock(F_UNLCK, number);
  fcntl(descriptor_, F_OFD_SETLK, &lock);
}

void Claims::wait_for(std::int64_t number) {
  struct flock lock = byte_lock(F_WRLCK, number);
  if (fcntl(descriptor_, F_OFD_SETLKW, &lock) == 0) release(number);
}

}  // namespace umbsim
