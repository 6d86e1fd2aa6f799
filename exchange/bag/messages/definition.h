#pragma once

#include <map>
#include <string>
#include <vector>

namespace umbsim::exchange {

/// A field of a message type.
struct Field {
  std::string name;
  std::string type;  ///< "float64", "string", or a struct's name as in "geometry_msgs/Pose"
  bool is_array = false;
  std::size_t count = 0;  ///< of a fixed array; 0: a sequence, which carries its length
};

/// Structs by name ("std_msgs/Header"; the middle word "msg" is left out).
using Definitions = std::map<std::string, std::vector<Field>>;

/// "sensor_msgs/msg/JointState" and "sensor_msgs::msg::JointState" -> "sensor_msgs/JointState".
std::string short_type(const std::string& type);

bool is_primitive(const std::string& type);

/// Structs of a definition as bags carry it: the type's own text, then those of the types in it behind lines of "=".
/// `encoding`: ros1msg, ros2msg or ros2idl. Throws InputError naming the line that cannot be understood.
Definitions parse_definition(const std::string& type, const std::string& text, const std::string& encoding);

/// Of the types that are read, as ROS 2 ships them: for bags that carry none.
const Definitions& shipped_definitions();

}  // namespace umbsim::exchange
