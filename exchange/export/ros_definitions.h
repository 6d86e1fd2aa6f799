#pragma once

#include <string>

namespace umbsim::exchange {

/// Message definitions as rosbag2 puts them into MCAP (encoding ros2msg): the type's text, then those of the types in
/// it. Of ROS 2's common_interfaces, without comments. Throws std::out_of_range for other types.
std::string ros2_definition(const std::string& type);

}  // namespace umbsim::exchange
