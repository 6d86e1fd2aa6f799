#include "gap/replay/signature_files.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <fstream>
#include <sstream>

#include "core/sha256.h"

namespace umbsim::gap {
namespace {

namespace fs = std::filesystem;

// A file: this line, the key, the numbers' bytes, the SHA-256 of all that.
const std::string kHeader = "umbsim-signature/1\n";
constexpr std::size_t kHashDigits = 64;
constexpr auto kAbandoned = std::chrono::hours(1);  // after which a file that nobody finished is removed
constexpr double kKeptShare = 0.9;                  // of the bound, so that not every call has to trim

std::string content(const std::string& key, const std::vector<double>& numbers) {
  std::string text = kHeader + key;
  text.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(double));
  return text + sha256(text);
}

bool is_temporary(const fs::path& file) { return file.extension() == ".part"; }

}  // namespace

SignatureFiles::SignatureFiles(fs::path folder, std::uint64_t max_bytes)
    : folder_(std::move(folder)), max_bytes_(max_bytes) {}

SignatureFiles::~SignatureFiles() {
  try {
    if (written_ > 0) trim();
  } catch (const std::exception&) {
    // Another process removes files at the same time: it trims, too.
  }
}

fs::path SignatureFiles::file_of(const std::string& key) const { return folder_ / key.substr(0, 2) / key; }

std::optional<std::vector<double>> SignatureFiles::read(const std::string& key) const {
  std::ifstream in(file_of(key), std::ios::binary);
  if (!in) return std::nullopt;
  std::ostringstream whole;
  whole << in.rdbuf();
  const std::string text = std::move(whole).str();
  const std::size_t head = kHeader.size() + kHashDigits;
  if (text.size() < head + kHashDigits || text.compare(0, head, kHeader + key) != 0) return std::nullopt;
  const std::size_t bytes = text.size() - head - kHashDigits;
  if (bytes % sizeof(double) != 0) return std::nullopt;
  if (sha256(std::string_view(text).substr(0, head + bytes)) != text.substr(head + bytes)) return std::nullopt;
  std::vector<double> numbers(bytes / sizeof(double));
  if (bytes > 0) std::memcpy(numbers.data(), text.data() + head, bytes);
  return numbers;
}

void SignatureFiles::write(const std::string& key, const std::vector<double>& numbers) {
  if (!writable_) return;
  const fs::path file = file_of(key);
  std::error_code failed;
  fs::create_directories(file.parent_path(), failed);
  const fs::path part = file.parent_path() / fmt::format("{}-{}-{}.part", key.substr(0, 16), getpid(), written_++);
  const std::string text = content(key, numbers);
  {
    std::ofstream out(part, std::ios::binary);
    out.write(text.data(), std::streamsize(text.size()));
    out.close();
    if (out) fs::rename(part, file, failed);
    if (out && !failed) return;
  }
  writable_ = false;
  fs::remove(part, failed);
}

void SignatureFiles::trim() const {
  struct Kept {
    fs::file_time_type time;
    std::uint64_t bytes;
    fs::path path;
  };
  std::vector<Kept> kept;
  std::uint64_t total = 0;
  std::error_code gone;
  const auto old = fs::file_time_type::clock::now() - kAbandoned;
  for (auto it = fs::recursive_directory_iterator(folder_, gone); !gone && it != fs::end(it); it.increment(gone)) {
    std::error_code ignored;
    if (!it->is_regular_file(ignored)) continue;
    const auto time = it->last_write_time(ignored);
    if (ignored) continue;
    if (is_temporary(it->path())) {
      if (time < old) fs::remove(it->path(), ignored);
      continue;
    }
    kept.push_back({time, it->file_size(ignored), it->path()});
    if (ignored)
      kept.pop_back();
    else
      total += kept.back().bytes;
  }
  if (total <= max_bytes_) return;
  std::sort(kept.begin(), kept.end(), [](const Kept& a, const Kept& b) { return a.time < b.time; });
  for (const Kept& k : kept) {
    if (double(total) <= kKeptShare * double(max_bytes_)) return;
    std::error_code ignored;
    fs::remove(k.path, ignored);
    total -= k.bytes;
  }
}

}  // namespace umbsim::gap
