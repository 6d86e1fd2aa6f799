#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "exchange/bag/messages/message_reader.h"
#include "exchange/import/log.h"

namespace umbsim::exchange {

/// A topic of a bag.
struct Topic {
  std::string name;
  std::string type;  ///< short, as in "sensor_msgs/JointState"
  std::string definition;
  std::string definition_encoding;  ///< ros1msg, ros2msg, ros2idl; empty: the bag carries none
  std::string serialization;        ///< cdr, ros1, or what is not read
};

/// A message as it lies in the bag; valid during the call that brings it.
struct BagMessage {
  std::size_t topic;
  Nanoseconds received;
  const std::uint8_t* data;
  std::size_t size;
};

/// One bag file. Everything throws InputError naming file and place: not such a file, cut off, damaged.
class Bag {
 public:
  virtual ~Bag() = default;
  virtual const std::vector<Topic>& topics() const = 0;
  /// Messages of these topics in the order in which they were received.
  virtual void read(const std::set<std::size_t>& topics, const std::function<void(const BagMessage&)>& take) const = 0;
};

class UnpackedFile;

/// `file` is what messages call it; `unpacked`: where its bytes are, if zstd packed it as a whole.
std::unique_ptr<Bag> open_mcap(const std::string& file, const UnpackedFile* unpacked = nullptr);
std::unique_ptr<Bag> open_db3(const std::string& file, const UnpackedFile* unpacked = nullptr);
std::unique_ptr<Bag> open_ros1(const std::string& file, const UnpackedFile* unpacked = nullptr);

/// The files of a bag: `path` itself, or those of a rosbag2 folder in their order; empty if it is no bag.
std::vector<std::string> bag_files(const std::string& path);

/// Opens one file by what it begins with, through zstd where that packed the file.
std::unique_ptr<Bag> open_bag(const std::string& file);

}  // namespace umbsim::exchange
