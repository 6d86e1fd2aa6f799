#pragma once

#include <string>

namespace umbsim::exchange {

/// Holds the sizes and places that a ROS 1 bag claims (http://wiki.ros.org/Bags/Format/2.0) against the bytes that are
/// there, before rosbag takes memory for them. A bag without an index is left to rosbag. `path` is read, `name` is how
/// messages call it. Throws InputError.
void check_ros1_sizes(const std::string& path, const std::string& name);

}  // namespace umbsim::exchange
