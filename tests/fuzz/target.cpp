#include "tests/fuzz/target.h"

#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <stdexcept>

namespace umbsim::fuzz {
namespace {

namespace fs = std::filesystem;

struct Temporary {
  Temporary() {
    std::string pattern = (fs::is_directory("/dev/shm") ? "/dev/shm" : "/tmp") + std::string("/umbsim_fuzz_XXXXXX");
    if (!mkdtemp(pattern.data())) throw std::runtime_error("no temporary folder");
    path = pattern;
  }
  ~Temporary() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  fs::path path;
};

}  // namespace

const fs::path& folder() {
  static const Temporary temporary;
  return temporary.path;
}

std::string written(const std::string& name, std::string_view text) {
  const fs::path file = folder() / name;
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary).write(text.data(), std::streamsize(text.size()));
  return file.string();
}

std::string_view next_part(std::string_view& data) {
  constexpr std::string_view kBar = "====\n";
  const std::size_t end = data.find(kBar);
  const std::string_view part = data.substr(0, end);
  data = end == data.npos ? std::string_view() : data.substr(end + kBar.size());
  return part;
}

}  // namespace umbsim::fuzz
