#include "exchange/bag/bag.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "core/error.h"
#include "core/text/yaml_reader.h"
#include "exchange/bag/files/mcap_records.h"
#include "exchange/bag/files/ros1_sizes.h"
#include "exchange/bag/files/unpacked_file.h"

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

std::unique_ptr<Bag> open_by(const std::string& begin, const std::string& file, const UnpackedFile* unpacked) {
  if (is_mcap(begin)) return open_mcap(file, unpacked);
  if (is_sqlite(begin)) return open_db3(file, unpacked);
  if (is_ros1(begin)) {
    check_ros1_sizes(unpacked ? unpacked->path() : file, file);
    return open_ros1(file, unpacked);
  }
  throw InputError(SourceMark{file}, begin.empty() ? "is empty" : "is no bag: neither MCAP, SQLite (.db3) nor ROS 1");
}

/// A bag in a file that was packed as a whole.
class PackedBag : public Bag {
 public:
  explicit PackedBag(const std::string& file)
      : unpacked_(file), bag_(open_by(beginning(unpacked_.path()), file, &unpacked_)) {}
  const std::vector<Topic>& topics() const override { return bag_->topics(); }
  void read(const std::set<std::size_t>& topics, const std::function<void(const BagMessage&)>& take) const override {
    bag_->read(topics, take);
  }

 private:
  UnpackedFile unpacked_;
  std::unique_ptr<Bag> bag_;
};

// Files as metadata.yaml lists them, else by name.
std::vector<std::string> files_in(const fs::path& folder) {
  std::vector<std::string> files;
  if (fs::exists(folder / "metadata.yaml")) {
    const YamlValue document = YamlValue::load((folder / "metadata.yaml").string());
    YamlMap top(document);
    YamlMap information(top.at("rosbag2_bagfile_information"));
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
  if (!fs::is_directory(path, ignored)) {
    const std::string begin = beginning(path), extension = fs::path(path).extension().string();
    const bool named = extension == ".bag" || extension == ".db3" || extension == ".mcap";
    if (!is_mcap(begin) && !is_zstd(begin.data(), begin.size()) && !is_sqlite(begin) && !is_ros1(begin) && !named)
      return {};
  }
  return files;
}

std::unique_ptr<Bag> open_bag(const std::string& file) {
  const std::string begin = beginning(file);
  if (is_zstd(begin.data(), begin.size())) return std::make_unique<PackedBag>(file);
  return open_by(begin, file, nullptr);
}

}  // namespace umbsim::exchange
