#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "exchange/bag/messages/definition.h"

namespace umbsim::exchange {

/// How a bag writes its messages.
enum class Wire { cdr, ros1 };

/// What was read of one message: for every path that was asked for, its numbers or texts in order. Arrays on the way
/// give as many as they have.
struct MessageValues {
  std::vector<std::vector<double>> numbers;
  std::vector<std::vector<std::string>> texts;
};

/// Finds fields by their names in messages of one type, as the bag defines it.
class MessageReader {
 public:
  /// `paths`: "header.stamp.sec", "transforms.child_frame_id". Throws InputError: a struct that is not defined, a path
  /// that the type does not have.
  MessageReader(const std::string& type, const Definitions& definitions, const std::vector<std::string>& paths,
                Wire wire);
  ~MessageReader();
  MessageReader(MessageReader&&) noexcept;

  /// Throws InputError where the bytes do not fit the definition.
  void read(const std::uint8_t* data, std::size_t size, MessageValues& values) const;

 private:
  struct Node;
  std::unique_ptr<Node> root_;
  std::string type_;
  std::size_t paths_;
  Wire wire_;
};

}  // namespace umbsim::exchange
