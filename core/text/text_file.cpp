#include "core/text/text_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "core/error.h"

namespace umbsim {
namespace {

struct Close {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Close>;

InputError cannot_read(const std::string& name, const char* why) {
  return InputError(SourceMark{name}, fmt::format("cannot be read: {}", why));
}

}  // namespace

std::string read_text_file(const std::filesystem::path& file, std::size_t max_bytes) {
  const std::string name = file.string();
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) throw cannot_read(name, "it is a directory");
  const File stream(std::fopen(name.c_str(), "rb"));
  if (!stream) throw cannot_read(name, std::strerror(errno));

  std::string text;
  char block[1 << 16];
  while (const std::size_t count = std::fread(block, 1, sizeof block, stream.get())) {
    text.append(block, count);
    if (text.size() > max_bytes) {
      throw InputError(SourceMark{name}, fmt::format("is longer than the {} bytes allowed", max_bytes));
    }
  }
  if (std::ferror(stream.get())) throw cannot_read(name, std::strerror(errno));
  return text;
}

void write_text_file(const std::filesystem::path& file, std::string_view text) {
  const std::string name = file.string();
  File stream(std::fopen(name.c_str(), "wb"));
  if (!stream) throw RunError(fmt::format("{}: cannot be written: {}", name, std::strerror(errno)));
  const bool written = std::fwrite(text.data(), 1, text.size(), stream.get()) == text.size();
  const int write_error = errno;
  // A full disk may show only when the buffer is flushed on closing.
  const bool closed = std::fclose(stream.release()) == 0;
  if (!written || !closed) {
    throw RunError(
        fmt::format("{}: cannot be written completely: {}", name, std::strerror(written ? errno : write_error)));
  }
}

void replace_text_file(const std::filesystem::path& file, std::string_view text) {
  std::filesystem::path part = file;
  part += fmt::format(".{}.part", getpid());
  std::error_code error, ignored;
  try {
    write_text_file(part, text);
  } catch (const RunError&) {
    std::filesystem::remove(part, ignored);
    throw;
  }
  std::filesystem::rename(part, file, error);
  if (!error) return;
  std::filesystem::remove(part, ignored);
  throw RunError(fmt::format("{}: cannot be written: {}", file.string(), error.message()));
}

}  // namespace umbsim
