#pragma once

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>

#include <cstdint>
#include <cstring>
#include <string>

#include "core/error.h"

namespace umbsim::exchange {

/// Common Data Representation (ROS 2), by eProsima's Fast CDR.
class CdrReader {
 public:
  CdrReader(const std::uint8_t* data, std::size_t size)
      : buffer_(reinterpret_cast<char*>(const_cast<std::uint8_t*>(data)), size),
        cdr_(buffer_, eprosima::fastcdr::Cdr::DEFAULT_ENDIAN, eprosima::fastcdr::Cdr::DDS_CDR) {
    cdr_.read_encapsulation();
  }

  template <class T>
  T number() {
    T value;
    cdr_.deserialize(value);
    return value;
  }
  std::string text() {
    std::string value;
    cdr_.deserialize(value);
    return value;
  }
  void wide_text() {
    std::wstring value;
    cdr_.deserialize(value);
  }
  /// A struct without fields is one byte.
  void empty_struct() { number<std::uint8_t>(); }

 private:
  eprosima::fastcdr::FastBuffer buffer_;
  eprosima::fastcdr::Cdr cdr_;
};

/// ROS 1's own: little endian, nothing aligned.
class Ros1Reader {
 public:
  Ros1Reader(const std::uint8_t* data, std::size_t size) : at_(data), left_(size) {}

  template <class T>
  T number() {
    T value;
    std::memcpy(&value, take(sizeof(T)), sizeof(T));
    return value;
  }
  std::string text() {
    const auto size = number<std::uint32_t>();
    return {reinterpret_cast<const char*>(take(size)), size};
  }
  void wide_text() { throw InputError("ROS 1 has no wide strings"); }
  void empty_struct() {}

 private:
  const std::uint8_t* take(std::size_t size) {
    if (size > left_) throw InputError("the message ends too soon");
    const std::uint8_t* here = at_;
    at_ += size;
    left_ -= size;
    return here;
  }
  const std::uint8_t* at_;
  std::size_t left_;
};

}  // namespace umbsim::exchange
