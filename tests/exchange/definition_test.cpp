// Message definitions as bags carry them, and messages read by them. The bytes are written out by hand from the
// specifications.
#include "exchange/bag/messages/definition.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "exchange/bag/messages/array_length.h"
#include "exchange/bag/messages/message_reader.h"

namespace umbsim::exchange {
namespace {

const char* const kMsg = R"(# a comment
int8 KIND=3   # a constant
string NAME="x = y"
std_msgs/Header header
Wheel[] wheels  # of this package
float64[2] pair
string<=10 label
uint8[<=4] few
float32 gain 2.5
================================================================================
MSG: my_msgs/Wheel
string name
float64 position
================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
)";

const char* const kIdl = R"(================================================================================
IDL: my_msgs/msg/Robot
// generated from rosidl_adapter
#include "std_msgs/msg/Header.idl"
module my_msgs {
  module msg {
    module Robot_Constants {
      const int8 KIND = 3;
    };
    typedef double double__2[2];
    @verbatim (language="comment", text=
      "Wheels; of this package" "{ not a brace }")
    struct Robot {
      std_msgs::msg::Header header;
      sequence<my_msgs::msg::Wheel> wheels;
      @unit (value="m")
      double__2 pair;
      string<10> label;
      sequence<uint8, 4> few;
      @default (value=2.5)
      float gain;
    };
  };
};
================================================================================
IDL: my_msgs/msg/Wheel
module my_msgs { module msg { struct Wheel { string name; double position; }; }; };
================================================================================
IDL: std_msgs/msg/Header
module std_msgs { module msg { struct Header { builtin_interfaces::msg::Time stamp; string frame_id; }; }; };
================================================================================
IDL: builtin_interfaces/msg/Time
module builtin_interfaces { module msg { struct Time { long sec; unsigned long nanosec; }; }; };
)";

// Little endian CDR of that struct: every number at a multiple of its size, counted behind the header of four bytes.
std::vector<std::uint8_t> cdr_bytes() {
  std::vector<std::uint8_t> body;
  const auto pad = [&](std::size_t to) {
    while (body.size() % to) body.push_back(0);
  };
  const auto put = [&](const void* p, std::size_t n) {
    pad(n);
    const auto* b = static_cast<const std::uint8_t*>(p);
    body.insert(body.end(), b, b + n);
  };
  const auto u32 = [&](std::uint32_t v) { put(&v, 4); };
  const auto f64 = [&](double v) { put(&v, 8); };
  const auto text = [&](const std::string& s) {
    u32(std::uint32_t(s.size() + 1));
    body.insert(body.end(), s.begin(), s.end());
    body.push_back(0);
  };
  u32(7);
  u32(9);
  text("f");
  u32(2);
  text("ab");
  f64(2);
  text("c");
  f64(-3);
  f64(4);
  f64(5);
  text("hello");
  u32(3);
  body.insert(body.end(), {1, 2, 3});
  const float gain = 0.5f;
  put(&gain, 4);
  body.insert(body.begin(), {0, 1, 0, 0});
  return body;
}

void expect_read(const Definitions& d) {
  const MessageReader reader("my_msgs/msg/Robot", d,
                             {"header.stamp.nanosec", "wheels.name", "wheels.position", "pair", "few", "gain"},
                             Wire::cdr);
  const std::vector<std::uint8_t> bytes = cdr_bytes();
  MessageValues v;
  reader.read(bytes.data(), bytes.size(), v);
  EXPECT_EQ(v.numbers[0], std::vector<double>({9}));
  EXPECT_EQ(v.texts[1], std::vector<std::string>({"ab", "c"}));
  EXPECT_EQ(v.numbers[2], std::vector<double>({2, -3}));
  EXPECT_EQ(v.numbers[3], std::vector<double>({4, 5}));
  EXPECT_EQ(v.numbers[4], std::vector<double>({1, 2, 3}));
  EXPECT_EQ(v.numbers[5], std::vector<double>({0.5}));
}

TEST(Definition, FieldsOfAMsgAreFoundByName) { expect_read(parse_definition("my_msgs/msg/Robot", kMsg, "ros2msg")); }

TEST(Definition, FieldsOfAnIdlAreFoundByName) { expect_read(parse_definition("my_msgs/msg/Robot", kIdl, "ros2idl")); }

TEST(Definition, WhatIsNotThereIsNamed) {
  const Definitions d = parse_definition("my_msgs/msg/Robot", kMsg, "ros2msg");
  try {
    MessageReader("my_msgs/Robot", d, {"velocity"}, Wire::cdr);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("no field 'velocity'"), std::string::npos) << e.what();
  }
  EXPECT_THROW(MessageReader("my_msgs/Other", d, {"a"}, Wire::cdr), InputError);
}

TEST(Definition, MessagesThatEndTooSoonAreNamed) {
  const Definitions d = parse_definition("my_msgs/msg/Robot", kMsg, "ros2msg");
  const MessageReader reader("my_msgs/Robot", d, {"gain"}, Wire::cdr);
  std::vector<std::uint8_t> bytes = cdr_bytes();
  bytes.resize(bytes.size() / 2);
  MessageValues v;
  EXPECT_THROW(reader.read(bytes.data(), bytes.size(), v), InputError);
}

TEST(Definition, Ros1IsNotAligned) {
  const Definitions d = parse_definition("a/B", "uint8 n\ntime stamp\nfloat64 x\nstring s\n", "ros1msg");
  const MessageReader reader("a/B", d, {"n", "stamp.sec", "stamp.nanosec", "x", "s"}, Wire::ros1);
  const std::vector<std::uint8_t> bytes = {5, 1, 0, 0,    0,    2, 0, 0, 0, 0,   0,  0,
                                           0, 0, 0, 0xf0, 0x3f, 2, 0, 0, 0, 'h', 'i'};
  MessageValues v;
  reader.read(bytes.data(), bytes.size(), v);
  EXPECT_EQ(v.numbers[0], std::vector<double>({5}));
  EXPECT_EQ(v.numbers[1], std::vector<double>({1}));
  EXPECT_EQ(v.numbers[2], std::vector<double>({2}));
  EXPECT_EQ(v.numbers[3], std::vector<double>({1.0}));
  EXPECT_EQ(v.texts[4], std::vector<std::string>({"hi"}));
}

TEST(ArrayLength, IsAWholeNumberOrRefused) {
  EXPECT_EQ(array_length("36"), 36u);
  for (const char* bad : {"", "x", "3x", "-1", "99999999999999999999", "2000000000"})
    EXPECT_THROW(array_length(bad), InputError) << bad;
}

}  // namespace
}  // namespace umbsim::exchange
