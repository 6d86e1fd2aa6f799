#include "exchange/bag/bag.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "core/error.h"
#include "core/yaml_reader.h"
#include "exchange/bag/mcap_records.h"

namespace umbsim::exchange {
namespace {

namespace fs = std::filesystem;

std::string beginning(const std::string& file) {
  std::string text(16, '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(text.data(), std::streamsize(text.size()));
  text.resize(std::size_t(in.gcount()));
  return text;
}

bool is_mcap(const std::string& begin) { return begin.starts_with(mcap::kMagic); }
bool is_sqlite(const std::string& begin) { return begin.starts_with("SQLite format 3"); }
bool is_ros1(const std::string& begin) { return begin.starts_with("#ROSBAG V"); }

void refuse_compressed(const std::string& file) {
  throw InputError(SourceMark{file},
                   fmt::format("is compressed as a whole: unpack it with `zstd -d {}` and give that", file));
}

// Files as metadata.yaml lists them, else by name.
std::vector<std::string> files_in(const fs::path& folder) {
  std::vector<std::string> files;
  if (fs::exists(folder / "metadata.yaml")) {
    const YamlValue document = YamlValue::load((folder / "metadata.yaml").string());
    YamlMap top(document);
    YamlMap information(top.at("rosbag2_bagfile_information"));
    if (const auto mode = information.find("compression_mode"); mode && mode->string() == "MESSAGE") {
      mode->fail("messages are compressed one by one: convert the bag with `ros2 bag convert`");
    }
    for (const YamlValue& name : information.at("relative_file_paths").list()) {
      files.push_back((folder / fs::path(name.string()).filename()).string());
      if (!fs::exists(files.back())) name.fail(fmt::format("'{}' is not in the folder", files.back()));
    }
    return files;
  }
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string extension = entry.path().extension().string();
    if (extension == ".db3" || extension == ".mcap" || extension == ".zstd") files.push_back(entry.path().string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

std::vector<std::string> bag_files(const std::string& path) {
  std::error_code ignored;
  std::vector<std::string> files = fs::is_directory(path, ignored) ? files_in(path) : std::vector<std::string>{path};
  if (fs::is_directory(path, ignored) && files.empty()) {
    throw InputError(SourceMark{path}, "is a folder without a bag (metadata.yaml, .db3 or .mcap)");
  }
  for (const std::string& file : files) {
    if (beginning(file).starts_with("\x28\xb5\x2f\xfd")) refuse_compressed(file);
  }
  if (!fs::is_directory(path, ignored)) {
    const std::string begin = beginning(path), extension = fs::path(path).extension().string();
    const bool named = extension == ".bag" || extension == ".db3" || extension == ".mcap";
    if (!is_mcap(begin) && !is_sqlite(begin) && !is_ros1(begin) && !named) return {};
  }
  return files;
}

std::unique_ptr<Bag> open_bag(const std::string& file) {
  const std::string begin = beginning(file);
  if (is_mcap(begin)) return open_mcap(file);
  if (is_sqlite(begin)) return open_db3(file);
  if (is_ros1(begin)) return open_ros1(file);
  throw InputError(SourceMark{file}, begin.empty() ? "is empty" : "is no bag: neither MCAP, SQLite (.db3) nor ROS 1");
}

}  // namespace umbsim::exchange
